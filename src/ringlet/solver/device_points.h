// DevicePoints: points that a host's kernels have left in a buffer on the device, such as those of a mesh
// that it skins there, brought to where bodies that bend take them (BodyPoints).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/solver/compute_device.h"

namespace ringlet {

/// x, y, z as floats, point after point.
struct DevicePoints {
  void* buffer = nullptr;     // VkBuffer that can be copied from (VK_BUFFER_USAGE_TRANSFER_SRC_BIT)
  std::uint64_t offset = 0;   // of the first point [bytes], a multiple of 4
  std::uint32_t stride = 12;  // from a point to the next [bytes], a multiple of 4, from 12 to 1024
  std::uint32_t count = 0;
};

/// The points of each buffer, as they are once all that was submitted to the device's queue before is done.
/// It submits a copy and waits. Errors: a buffer, offset or stride that is none; the device lacks memory or
/// is lost.
Result<std::vector<std::vector<Vec3d>>> readPoints(const ComputeDevice& device,
                                                   std::span<const DevicePoints> buffers);

}  // namespace ringlet
