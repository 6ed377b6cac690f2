// Which subgroup widths strand kernels can have on a device, and which of them was fastest. Pure arithmetic,
// no device.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/solver/strand_shape.h"

namespace ringlet {

/// The widths that can be asked for: the device's own choice first, then the others, rising. Only the first
/// where the driver leaves no choice.
std::vector<std::uint32_t> subgroupSizes(const DeviceLimits& limits);

/// The limits for kernels of this width; 0: as they are. Fails, with what is possible, for any other width
/// than those of subgroupSizes.
Result<DeviceLimits> withSubgroupSize(const DeviceLimits& limits, int width);

/// Device time of strands of so many particles, in one shape and at one width.
struct WidthTime {
  std::uint32_t particleCount = 0, subgroupSize = 0;
  double nanoseconds = 0;
};
/// The width at which the best shapes of all lengths together are fastest, of those widths at which most
/// lengths were timed. Of equals the one that is timed first. 0 where there is none.
std::uint32_t fastestSubgroupSize(std::span<const WidthTime> times);

}  // namespace ringlet
