// A part of a groom, for hair that several devices simulate.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/rest/rest_state.h"

namespace ringlet {

/// Of each strand of a groom of so many: whether it is among `part`. Errors: as restrictTo. Cost: linear.
Result<std::vector<bool>> membersOf(std::span<const std::uint32_t> part, std::size_t strandCount);

/// Leaves of the strands that are simulated those of `part`, groom order; of the others the rest points stay
/// (RestState::elsewhere). Numbers of the whole groom stay as they are. Errors: a strand that the groom does
/// not have, or that is there twice. Cost: linear.
Status restrictTo(RestState& state, std::span<const std::uint32_t> part);

}  // namespace ringlet
