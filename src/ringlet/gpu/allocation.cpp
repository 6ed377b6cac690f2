// Implements gpu/allocation.h.
#include "ringlet/gpu/allocation.h"

#include <fmt/format.h>

#include <utility>

#include "ringlet/gpu/check.h"

namespace ringlet::gpu {

VkResult Allocation::make(Device& device, const VkMemoryRequirements& requirements, std::uint32_t type,
                          Allocation& made) {
  HostAllocation piece;
  VkResult result = VK_SUCCESS;
  if (const HostAllocator& host = device.hostAllocator(); host.allocate) {
    result = host.allocate(requirements, type, piece);
  } else {
    auto info = zeroed<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    info.allocationSize = requirements.size;
    info.memoryTypeIndex = type;
    result = device.vk().vkAllocateMemory(device.handle(), &info, nullptr, &piece.memory);
  }
  if (result != VK_SUCCESS) return result;
  made = Allocation();
  made.device_ = device.shared_from_this();
  made.piece_ = piece;
  return VK_SUCCESS;
}

Allocation::Allocation(Allocation&& other) noexcept
    : device_(std::move(other.device_)), piece_(std::exchange(other.piece_, {})) {}

Allocation& Allocation::operator=(Allocation&& other) noexcept {
  Allocation old(std::move(*this));
  device_ = std::move(other.device_);
  piece_ = std::exchange(other.piece_, {});
  return *this;
}

Allocation::~Allocation() {
  if (!device_ || !device_->isOfThisProcess()) return;
  if (const HostAllocator& host = device_->hostAllocator(); host.allocate) {
    host.free(piece_);
  } else {
    device_->vk().vkFreeMemory(device_->handle(), piece_.memory, nullptr);
  }
}

// Stays mapped: coherent memory needs no flush, and unmapping comes with freeing.
Result<std::byte*> Allocation::map(const std::string& attempt) {
  void* address = piece_.mapped;
  if (!device_->hostAllocator().allocate) {
    RINGLET_VK_CHECK(
        device_->vk().vkMapMemory(device_->handle(), piece_.memory, 0, VK_WHOLE_SIZE, 0, &address), attempt);
  }
  if (!address) {
    return Error{fmt::format(
        "could not {}: the host's allocator gave memory of a type that can be mapped, and did not map it",
        attempt)};
  }
  return static_cast<std::byte*>(address);
}

}  // namespace ringlet::gpu
