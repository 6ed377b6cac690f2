// Dials that cannot act in a run: whoever turns one should hear of it.
#pragma once

#include <string>
#include <vector>

#include "ringlet/groom/groom.h"
#include "ringlet/rest/material_dials.h"
#include "ringlet/scene/motion.h"
#include "ringlet/scene/settings.h"

namespace ringlet {

/// A sentence for each dial that is turned and changes nothing. material: the dials worked in. seconds: of
/// the run [s]. Cost: that of inspectShape where curlKeep is turned.
std::vector<std::string> idleDials(const MaterialDials& dials, const Material& material, const Groom& groom,
                                   const Settings& settings, const Motion& motion, double seconds);

}  // namespace ringlet
