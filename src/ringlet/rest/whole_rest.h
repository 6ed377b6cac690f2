// WholeRest: all that hair is at rest, of a whole groom. Parts of divided hair take theirs of one.
#pragma once

#include <optional>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"
#include "ringlet/rest/material.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/rest/rest_volume.h"
#include "ringlet/scene/settings.h"

namespace ringlet {

struct WholeRest {
  RestState state;
  std::optional<RestContacts> contacts{};  // where they are on
  std::optional<RestVolume> volume{};      // where strands meet as one
};

/// In the order in which strands that may touch are near each other in memory, where contacts are on; else in
/// the groom's. `geometry`: of the strands, where it is known; empty: measured here. Errors and cost: those
/// of buildRestState, buildRestContacts, buildRestVolume.
Result<WholeRest> buildWholeRest(const Groom& groom, const Material& material, const Settings& settings,
                                 std::span<const StrandGeometry> geometry = {});

}  // namespace ringlet
