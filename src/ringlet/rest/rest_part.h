// A part of a groom, for hair that is divided among several devices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/rest/rest_state.h"

namespace ringlet {

/// For each strand of a groom of this number of strands: whether it is in `part`. Errors: as restrictTo.
/// Cost: linear.
Result<std::vector<bool>> membersOf(std::span<const std::uint32_t> part, std::size_t strandCount);

/// Keeps the simulated strands that are in `part`, groom order. Of the others only the rest points are kept
/// (RestState::elsewhere). Members about the whole groom do not change. Errors: a strand that the groom does
/// not have, or one that is listed twice. Cost: linear.
Status restrictTo(RestState& state, std::span<const std::uint32_t> part);

}  // namespace ringlet
