// A host, as an engine is one: it makes Vulkan's instance, device and queue itself, watched by the validation
// layer with synchronisation, and lets Ringlet work on them. It knows Ringlet's public headers only.
#pragma once

#define VK_NO_PROTOTYPES
#include <gtest/gtest.h>
#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "ringlet/solver/compute_device.h"

namespace ringlet::test {

// Of the host's Vulkan, found by name.
struct Calls {
  PFN_vkGetInstanceProcAddr get = nullptr;
  VkInstance instance = VK_NULL_HANDLE;

  template <class Function>
  Function call(const char* name) const {
    const auto found = reinterpret_cast<Function>(get(instance, name));
    EXPECT_TRUE(found) << name;
    return found;
  }
};

class Host {
 public:
  static constexpr std::uint32_t kVersion = VK_API_VERSION_1_3;

  // Without features: as a host does that never heard of what Ringlet would like.
  explicit Host(bool asksForNeeds);
  ~Host();
  Host(const Host&) = delete;

  HostVulkan handles() { return handles_; }
  const std::shared_ptr<std::vector<std::string>>& messages() const { return messages_; }

  // Commands of the host's, handed to the queue; and until they are done.
  using Record = std::function<void(VkCommandBuffer)>;
  struct Work {
    VkCommandPool pool = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
  };
  Work submit(const Record& record);
  void wait(const Work& work);
  // What the host's own kernel finds in a buffer, after other commands of the same submission: it reads every
  // number, and a copy of it comes back.
  std::vector<std::uint32_t> read(
      VkBuffer source, std::uint64_t bytes, const Record& before = [](VkCommandBuffer) {});

 private:
  struct Owned {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    void* mapped = nullptr;
  };
  void makeInstance();
  void makeDevice(const HostVulkanNeeds& needs);
  Owned makeBuffer(std::uint64_t bytes, VkBufferUsageFlags usage);
  void drop(const Owned& owned);

  Calls calls_;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::shared_ptr<std::vector<std::string>> messages_ = std::make_shared<std::vector<std::string>>();
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  std::mutex queueMutex_;
  HostVulkan handles_;
};

}  // namespace ringlet::test
