// The subgroup widths that strand kernels can have on a device, and the fastest of them. Pure arithmetic, no
// device.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/solver/strand_shape.h"

namespace ringlet {

/// The widths that can be asked for: the device's own choice first, then the others, rising. Only the first
/// if the driver offers no choice.
std::vector<std::uint32_t> subgroupSizes(const DeviceLimits& limits);

/// The limits for kernels of this width; 0: unchanged. Fails, with the possible widths, for a width that is
/// not among subgroupSizes.
Result<DeviceLimits> withSubgroupSize(const DeviceLimits& limits, int width);

/// Device time of strands of one length, in one shape and at one width.
struct WidthTime {
  std::uint32_t particleCount = 0, subgroupSize = 0;
  double nanoseconds = 0;
};
/// The width at which the best shapes of all lengths are fastest in total. Only widths at which the most
/// lengths were timed are compared; of equal ones the first wins. 0 if there is none.
std::uint32_t fastestSubgroupSize(std::span<const WidthTime> times);

}  // namespace ringlet
