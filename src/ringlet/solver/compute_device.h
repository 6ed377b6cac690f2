// ComputeDevice: the Vulkan device on which simulations run. This header does not include Vulkan.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/solver/strand_shape.h"

namespace ringlet {
namespace gpu {
class Device;
}

/// A Vulkan device, as `ringlet devices` lists it.
struct DeviceSummary {
  int index = 0;
  std::string name;    // as the driver states it
  std::string type;    // discrete, integrated, virtual, cpu, other
  std::string driver;  // name and version
  std::uint64_t memoryBytes = 0;
  std::uint32_t reportedSubgroupSize = 0;    // by the driver [invocations]
  std::vector<std::uint32_t> subgroupSizes;  // that strand kernels can have, the default first
  bool usable = false;                       // has a compute queue and the limits the solver needs
  std::string why;                           // if not usable: what is missing
};

/// Device memory for one buffer, from a host's allocator.
struct HostMemory {
  void* memory = nullptr;  // VkDeviceMemory; where handles are 64 bits
  std::uint64_t offset = 0;
  void* mapped = nullptr;  // host address of the memory; required of host-visible memory types
  void* own = nullptr;     // the host's handle of the allocation, such as a VmaAllocation
};

/// A Vulkan device that a host opened. Members are the handles of <vulkan/vulkan.h>, which this header does
/// not include. The host keeps instance and device until everything made with them here is destroyed.
struct HostVulkan {
  void* getInstanceProcAddr = nullptr;  // PFN_vkGetInstanceProcAddr
  void* instance = nullptr;             // VkInstance
  void* physicalDevice = nullptr;       // VkPhysicalDevice
  void* device = nullptr;               // VkDevice
  void* queue = nullptr;                // VkQueue
  std::uint32_t queueFamily = 0;        // of the queue; it supports compute
  std::uint32_t apiVersion = 0;         // of the host's VkApplicationInfo, 1.1 at least
  bool subgroupSizeControl = false;     // features that the device was opened with
  bool computeFullSubgroups = false;
  bool atomicInt64 = false;  // shaderInt64 and shaderBufferInt64Atomics, which make pictures faster
  // Ringlet locks it while it submits to the queue. Without it the host must not submit during calls of
  // Ringlet.
  std::mutex* queueMutex = nullptr;
  // The host's allocator in place of vkAllocateMemory: both functions or none. allocate returns a VkResult;
  // after VK_ERROR_OUT_OF_DEVICE_MEMORY it is called with the next suitable memory type. Any thread that
  // creates something on the device calls these functions.
  std::function<int(std::uint64_t bytes, std::uint64_t alignment, std::uint32_t memoryType, HostMemory&)>
      allocate{};
  std::function<void(const HostMemory&)> free{};
};

/// Extensions and features with which a host should open a device. Ringlet also works without them, but more
/// slowly where kernels then do not know the width of a subgroup.
struct HostVulkanNeeds {
  std::vector<std::string> extensions;
  bool subgroupSizeControl = false;  // features, of VkPhysicalDeviceSubgroupSizeControlFeatures
  bool computeFullSubgroups = false;
  bool atomicInt64 = false;       // shaderInt64, and shaderBufferInt64Atomics of
                                  // VkPhysicalDeviceShaderAtomicInt64Features
  std::uint32_t queueFamily = 0;  // the best one; any that supports compute works
};

/// A handle, cheap to copy. The device closes with its last copy.
class ComputeDevice {
 public:
  /// Opens the device that `choice` names by index or part of its name. An empty choice means
  /// $RINGLET_DEVICE, else the best device (discrete, integrated, virtual, CPU). Fails where there is no
  /// Vulkan or no such device. `cacheFolder`: folder for the driver's compiled kernels; empty: they are not
  /// kept.
  static Result<ComputeDevice> open(const std::string& choice = "",
                                    const std::filesystem::path& cacheFolder = {});

  /// All devices, by index (the Vulkan loader's order). Empty where there is no Vulkan.
  static std::vector<DeviceSummary> list();

  /// Uses a host's device and never closes it. Fails where device or queue lack something the solver needs.
  static Result<ComputeDevice> adopt(const HostVulkan& host, const std::filesystem::path& cacheFolder = {});
  /// To be called before a host opens a device; `host` needs no device and queue yet. Fails where the device
  /// cannot run the solver.
  static Result<HostVulkanNeeds> needs(const HostVulkan& host);

  /// Wraps an open device, as tests and `ringlet kernels` open it with options of their own.
  static ComputeDevice over(std::shared_ptr<gpu::Device> device);

  std::string name() const;
  std::string driver() const;
  DeviceLimits limits() const;

  /// Fails in a child process made by fork() after the device was opened: nothing that was made with the
  /// device works there. Every function that needs the device fails in the same way.
  Status checkProcess() const;

  /// Messages of the validation layer so far (it is on when RINGLET_VALIDATION=1); a correct program has
  /// none.
  std::vector<std::string> validationMessages() const;

  gpu::Device& gpu() const { return *device_; }

 private:
  std::shared_ptr<gpu::Device> device_;
};

}  // namespace ringlet
