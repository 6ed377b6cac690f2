// Allocation: the memory of one buffer, by the driver or from a host's allocator.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "ringlet/base/result.h"
#include "ringlet/gpu/device.h"

namespace ringlet::gpu {

/// Freed with its owner; holds its device open. Move-only.
class Allocation {
 public:
  Allocation() = default;
  /// Memory of this type. VK_SUCCESS, or why there is none.
  static VkResult make(Device& device, const VkMemoryRequirements& requirements, std::uint32_t type,
                       Allocation& made);
  Allocation(Allocation&& other) noexcept;
  Allocation& operator=(Allocation&& other) noexcept;
  ~Allocation();

  VkDeviceMemory memory() const { return piece_.memory; }
  VkDeviceSize offset() const { return piece_.offset; }
  /// Maps the memory; returns its host address, valid as long as this lives. `attempt` completes "could not
  /// ...".
  Result<std::byte*> map(const std::string& attempt);

 private:
  std::shared_ptr<Device> device_;
  HostAllocation piece_;
};

}  // namespace ringlet::gpu
