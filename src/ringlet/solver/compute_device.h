// ComputeDevice: the Vulkan device simulations run on, without showing Vulkan.
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

/// One line of `ringlet devices`.
struct DeviceSummary {
  int index = 0;
  std::string name;    // as the driver states it
  std::string type;    // discrete, integrated, virtual, cpu, other
  std::string driver;  // name and version
  std::uint64_t memoryBytes = 0;
  std::uint32_t reportedSubgroupSize = 0;    // by the driver [invocations]
  std::vector<std::uint32_t> subgroupSizes;  // strand kernels can have, the default first
  bool usable = false;                       // has a compute queue and the limits the solver needs
  std::string why;                           // if not usable: what is missing
};

/// Device memory for one buffer, from a host's own allocator.
struct HostMemory {
  void* memory = nullptr;  // VkDeviceMemory; where handles are 64 bits
  std::uint64_t offset = 0;
  void* mapped = nullptr;  // where the host sees the piece; of memory types that can be mapped, which must be
  void* own = nullptr;     // whatever the host knows it by: a VmaAllocation
};

/// A Vulkan device that a host opened: handles as <vulkan/vulkan.h> has them, which this header does not
/// show. The host keeps the instance and the device until everything that was made with them here is gone.
struct HostVulkan {
  void* getInstanceProcAddr = nullptr;  // PFN_vkGetInstanceProcAddr
  void* instance = nullptr;             // VkInstance
  void* physicalDevice = nullptr;       // VkPhysicalDevice
  void* device = nullptr;               // VkDevice
  void* queue = nullptr;                // VkQueue
  std::uint32_t queueFamily = 0;        // the queue's, which computes
  std::uint32_t apiVersion = 0;         // of the host's VkApplicationInfo, 1.1 at least
  bool subgroupSizeControl = false;     // features that the device was opened with
  bool computeFullSubgroups = false;
  // Ringlet holds it while it hands work to the queue. Without it, the host hands over none during calls of
  // Ringlet.
  std::mutex* queueMutex = nullptr;
  // The host's allocator, in place of vkAllocateMemory: both or neither. allocate returns a VkResult; after
  // VK_ERROR_OUT_OF_DEVICE_MEMORY it is asked for memory of the next type that will do. Any thread that makes
  // something on the device calls them.
  std::function<int(std::uint64_t bytes, std::uint64_t alignment, std::uint32_t memoryType, HostMemory&)>
      allocate{};
  std::function<void(const HostMemory&)> free{};
};

/// What a host opens a device with, so that Ringlet can use all the device has. It works without extensions
/// and features too, slower where kernels then do not know the width of a subgroup.
struct HostVulkanNeeds {
  std::vector<std::string> extensions;
  bool subgroupSizeControl = false;  // features, of VkPhysicalDeviceSubgroupSizeControlFeatures
  bool computeFullSubgroups = false;
  std::uint32_t queueFamily = 0;  // the best one; any that computes will do
};

/// Cheap to copy; the device closes with its last copy.
class ComputeDevice {
 public:
  /// Opens the device `choice` names, by part of its name or by index; an empty choice takes $RINGLET_DEVICE,
  /// else the best (discrete, then integrated, then virtual, then CPU). Fails where there is no Vulkan or no
  /// such device.
  /// `cacheFolder`: where the driver's compiled kernels are kept between programs; empty: nowhere.
  static Result<ComputeDevice> open(const std::string& choice = "",
                                    const std::filesystem::path& cacheFolder = {});

  /// All devices, by index (the Vulkan loader's order). Empty where there is no Vulkan.
  static std::vector<DeviceSummary> list();

  /// Works on a host's device, and never closes it. Fails where device or queue lack what the solver needs.
  static Result<ComputeDevice> adopt(const HostVulkan& host, const std::filesystem::path& cacheFolder = {});
  /// Before a host opens a device; of `host` it asks for all but device and queue. Fails where the device
  /// cannot run the solver.
  static Result<HostVulkanNeeds> needs(const HostVulkan& host);

  /// A device that is open already, as tests and `ringlet kernels` open it with options of their own.
  static ComputeDevice over(std::shared_ptr<gpu::Device> device);

  std::string name() const;
  std::string driver() const;
  DeviceLimits limits() const;

  /// Messages of the validation layer so far (it is on when RINGLET_VALIDATION=1); a correct program has
  /// none.
  std::vector<std::string> validationMessages() const;

  gpu::Device& gpu() const { return *device_; }

 private:
  std::shared_ptr<gpu::Device> device_;
};

}  // namespace ringlet
