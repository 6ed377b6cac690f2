// A host, as an engine is one: it makes Vulkan's instance, device and queue itself, watched by the validation
// layer with synchronisation, and lets Ringlet work on them. It knows Ringlet's public headers only.
#pragma once

#define VK_NO_PROTOTYPES
#include <gtest/gtest.h>
#include <vulkan/vulkan.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
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
  // Memory of this type, mapped where it can be; and back.
  VkResult allocate(std::uint64_t bytes, std::uint32_t type, VkDeviceMemory& memory, std::byte*& mapped);
  void free(VkDeviceMemory memory);
  // What the host's own kernel finds in a buffer, after other commands of the same submission: it reads every
  // number, and a copy of it comes back.
  std::vector<std::uint32_t> read(
      VkBuffer source, std::uint64_t bytes, const Record& before = [](VkCommandBuffer) {});

  struct Owned {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    void* mapped = nullptr;
  };
  // A buffer into which commands write that are submitted, and may not be done yet; and when it is read.
  struct Written {
    Owned owned;
    Work work;
  };
  Written write(const std::vector<float>& numbers);
  void drop(const Written& written);

 private:
  // One that copies numbers, with a set of its buffers.
  struct Kernel {
    VkDescriptorSetLayout setLayout;
    VkPipelineLayout layout;
    VkShaderModule module;
    VkPipeline pipeline;
    VkDescriptorPool pool;
    VkDescriptorSet set;
  };
  void makeInstance();
  void makeDevice(const HostVulkanNeeds& needs);
  Owned makeBuffer(std::uint64_t bytes, VkBufferUsageFlags usage);
  void drop(const Owned& owned);
  Kernel makeKernel();
  void bind(Kernel& kernel, const std::array<VkDescriptorBufferInfo, 3>& buffers);
  void drop(const Kernel& kernel);

  Calls calls_;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::shared_ptr<std::vector<std::string>> messages_ = std::make_shared<std::vector<std::string>>();
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  std::mutex queueMutex_;
  HostVulkan handles_;
};

// A host's own allocator: pieces of one block of memory for each type, each kept until it comes back.
class HostPool {
 public:
  HostPool(Host& host, std::uint64_t bytesOfABlock) : host_(&host), bytes_(bytesOfABlock) {}
  ~HostPool();
  HostPool(const HostPool&) = delete;

  // Into handles that are then adopted with it.
  void serve(HostVulkan& handles);
  std::size_t given() const { return given_; }
  std::size_t kept() const { return kept_.size(); }  // of these

 private:
  struct Block {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::byte* mapped = nullptr;
    std::uint64_t used = 16;  // so that no piece is all of the memory
  };
  int allocate(std::uint64_t bytes, std::uint64_t alignment, std::uint32_t type, HostMemory& piece);

  Host* host_;
  std::uint64_t bytes_;
  std::mutex mutex_;
  std::map<std::uint32_t, Block> blocks_;
  std::set<void*> kept_;
  std::size_t given_ = 0;
};

}  // namespace ringlet::test
