// What `ringlet tune` measured, remembered in the program's cache folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/strand_shape.h"

namespace ringlet::program {

struct TunedShapes {
  std::vector<ShapeCost> costs;    // none: nothing is known of this device, driver and kernels
  std::uint32_t subgroupSize = 0;  // they were measured at; 0: the device's default
  std::string warning;             // why the file could not be read
  bool isOutdated = false;         // the device was tuned, but with another driver or other kernels
};

/// Of this device, as tuned last. Never fails: without the file shapes are chosen by a model.
TunedShapes recallShapes(const ComputeDevice& device);

/// In place of what was known of this device, driver and kernels; what is known of others stays, unless the
/// file is broken. Returns the file. Errors: no cache folder, or one that cannot be written.
Result<std::filesystem::path> rememberShapes(const ComputeDevice& device, const std::vector<ShapeCost>& costs,
                                             std::uint32_t subgroupSize);

}  // namespace ringlet::program
