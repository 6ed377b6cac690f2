// The results of `ringlet tune`, stored in the program's cache folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/strand_shape.h"

namespace ringlet::program {

struct TunedShapes {
  std::vector<ShapeCost> costs;    // empty: nothing is known for this device, driver and kernels
  std::uint32_t subgroupSize = 0;  // at which they were measured; 0: the device's default
  std::string warning;             // why the file could not be read
  bool isOutdated = false;         // the device was tuned with another driver or other kernels
};

/// The latest results for this device. Never fails: without the file a cost model chooses shapes.
TunedShapes recallShapes(const ComputeDevice& device);

/// Replaces the results for this device, driver and kernels; others are kept, unless the file is broken.
/// Returns the file's path. Errors: there is no cache folder, or it cannot be written.
Result<std::filesystem::path> rememberShapes(const ComputeDevice& device, const std::vector<ShapeCost>& costs,
                                             std::uint32_t subgroupSize);

}  // namespace ringlet::program
