// Owned: a Vulkan object that is destroyed with its owner and holds its device open (but see keptByDevice).
// Move-only.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "ringlet/gpu/device.h"

namespace ringlet::gpu {

/// For objects that the device itself keeps, and destroys before it closes: does not hold the device open.
inline std::shared_ptr<Device> keptByDevice(Device& device) { return {std::shared_ptr<Device>(), &device}; }

/// `destroy` is the table's function that ends a Handle.
template <class Handle, auto destroy>
class Owned {
 public:
  Owned() = default;
  Owned(std::shared_ptr<Device> device, Handle handle) : device_(std::move(device)), handle_(handle) {}
  Owned(Owned&& other) noexcept
      : device_(std::move(other.device_)), handle_(std::exchange(other.handle_, Handle{})) {}
  Owned& operator=(Owned&& other) noexcept {
    Owned old(std::move(*this));
    device_ = std::move(other.device_);
    handle_ = std::exchange(other.handle_, Handle{});
    return *this;
  }
  ~Owned() {
    if (handle_ && device_->isOfThisProcess()) (device_->vk().*destroy)(device_->handle(), handle_, nullptr);
  }

  explicit operator bool() const { return handle_ != Handle{}; }
  Handle get() const { return handle_; }

 private:
  std::shared_ptr<Device> device_;
  Handle handle_{};
};

using OwnedBuffer = Owned<VkBuffer, &VolkDeviceTable::vkDestroyBuffer>;
using OwnedBufferView = Owned<VkBufferView, &VolkDeviceTable::vkDestroyBufferView>;
using OwnedShaderModule = Owned<VkShaderModule, &VolkDeviceTable::vkDestroyShaderModule>;
using OwnedSetLayout = Owned<VkDescriptorSetLayout, &VolkDeviceTable::vkDestroyDescriptorSetLayout>;
using OwnedPipelineLayout = Owned<VkPipelineLayout, &VolkDeviceTable::vkDestroyPipelineLayout>;
using OwnedPipeline = Owned<VkPipeline, &VolkDeviceTable::vkDestroyPipeline>;
using OwnedDescriptorPool = Owned<VkDescriptorPool, &VolkDeviceTable::vkDestroyDescriptorPool>;
using OwnedCommandPool = Owned<VkCommandPool, &VolkDeviceTable::vkDestroyCommandPool>;
using OwnedQueryPool = Owned<VkQueryPool, &VolkDeviceTable::vkDestroyQueryPool>;
using OwnedFence = Owned<VkFence, &VolkDeviceTable::vkDestroyFence>;

}  // namespace ringlet::gpu
