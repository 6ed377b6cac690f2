// WholeRest: the complete rest state of a whole groom. Parts of divided hair take theirs from one.
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
  std::optional<RestContacts> contacts{};  // if contacts are on
  std::optional<RestVolume> volume{};      // if some strands are a volume
};

/// With contacts, strands are ordered such that those that may touch are near each other in memory; otherwise
/// in groom order. `geometry`: of the strands, if it is known; empty: it is measured. Errors and cost: those
/// of buildRestState, buildRestContacts, buildRestVolume.
Result<WholeRest> buildWholeRest(const Groom& groom, const Material& material, const Settings& settings,
                                 std::span<const StrandGeometry> geometry = {});

}  // namespace ringlet
