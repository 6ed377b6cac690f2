// Device: an open Vulkan device with one compute queue, and its properties. Buffers, kernels and recorders
// hold their device open; it closes with the last of them.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/gpu/instance.h"
#include "ringlet/gpu/pipeline_cache_file.h"
#include "ringlet/gpu/vulkan.h"

namespace ringlet::gpu {

class KernelCache;

// What the solver needs, checked when a device is opened. Vulkan promises 4 storage buffers a stage; nearly
// every driver has 8 and more.
inline constexpr std::uint32_t kNeededApiVersion = VK_API_VERSION_1_1;
inline constexpr std::uint32_t kNeededStorageBuffers = 7;     // bound to one kernel, by hair alone
inline constexpr std::uint32_t kNeededGroupInvocations = 64;  // invocations of a workgroup
inline constexpr std::uint32_t kNeededPushConstantBytes = 128;

/// What kernels tell of the machine code the driver made of them (kernel_executables.h): nothing, the
/// subgroup size, or registers and the like too, for which the driver must keep them as it compiles.
enum class Inspection { none, sizes, statistics };

struct DeviceProperties {
  int index = 0;                    // in the order of the Vulkan loader
  std::string name;                 // as the driver states it
  std::string driver;               // name and version, in words where the driver gives them
  std::string type;                 // discrete, integrated, virtual, cpu, other
  std::uint32_t apiVersion = 0;     // the highest usable here, as VK_MAKE_API_VERSION packs it
  std::uint32_t driverId = 0;       // VkDriverId; 0: the driver does not say
  std::uint32_t driverVersion = 0;  // packed as the driver likes
  std::uint32_t vendorId = 0, deviceId = 0;
  std::uint32_t subgroupSize = 1;          // invocations; of kernels that ask for no width
  std::uint32_t reportedSubgroupSize = 1;  // the driver's default
  std::uint32_t minSubgroupSize = 1;       // the driver's range; both as reported if it states none
  std::uint32_t maxSubgroupSize = 1;
  bool canChooseSubgroupSize = false;       // a kernel can ask for any power of two of the range
  bool hasSubgroupShuffle = false;          // basic and shuffle operations in compute kernels
  bool hasAtomicInt64 = false;              // 64-bit integers, and atomics on them in storage buffers
  bool hasFullSubgroups = false;            // a kernel can insist that no subgroup of it has gaps
  std::uint32_t maxGroupSubgroups = 0;      // of a workgroup that asks for a width or for full subgroups
  std::uint64_t maxStorageBufferRange = 0;  // [bytes] largest buffer a kernel can see
  std::uint64_t maxUniformBufferRange = 0;  // [bytes]
  std::uint64_t maxTexelRecords = 0;        // 16-byte records a kernel can see as texels
  std::uint64_t memoryBytes = 0;            // of its own heaps; of all heaps if it has none
  std::uint64_t maxAllocationBytes = 0;     // [bytes] largest single piece of memory
  std::uint32_t maxStorageBuffers = 0;      // bound to one kernel
  std::uint32_t maxGroupCount = 0;          // workgroups of one dispatch, along x
  std::uint32_t maxGroupInvocations = 0;    // invocations of a workgroup
  std::uint32_t maxPushConstantBytes = 0;
  std::uint32_t maxSharedMemoryBytes = 0;    // of a workgroup
  Inspection inspection = Inspection::none;  // that was asked for, where the device has it
  bool isCpu = false;  // kernels take the forms that suit a processor, else those for a GPU
  bool hasTimestamps = false;
  double timestampPeriod = 0;       // [ns] of one tick
  std::uint32_t timestampBits = 0;  // valid bits of a timestamp
};

/// A device of this machine, usable or not.
struct DeviceListing {
  DeviceProperties properties;
  bool usable = false;
  std::string why;  // if not usable: what is missing, with numbers
};

/// How a device is opened. Most of it turns off what a device has, so that tests and `ringlet conform` reach
/// the paths for devices without it.
struct DeviceOptions {
  bool alwaysStage = false;            // never map storage buffers, copy through a staging buffer
  bool withoutTimestamps = false;      // time by the host's clock
  bool withoutFullSubgroups = false;   // leave subgroup sizes to the driver
  bool withoutAtomicInt64 = false;     // two passes of 32 bits in place of one of 64
  bool asGpu = false;                  // a processor's kernels take the forms for a GPU
  bool withoutMemoryBudget = false;    // count what this device took; a budget moves with other programs
  std::uint64_t mostTexelRecords = 0;  // a kernel sees as texels; 0: as many as the device has
  Inspection inspection = Inspection::none;  // for `ringlet kernels`; drivers crash in their own statistics
  bool allowNull = false;  // open null hardware too: it has no memory and only compiles kernels
  /// Changes a kernel's SPIR-V before it is compiled: shows that a wrong kernel is noticed.
  std::function<void(const std::string& kernel, std::vector<std::uint32_t>& spirv)> changeCode{};
  std::uint32_t mostStorageBuffers = 0;  // bound to one kernel; 0: as many as the device has
  // Of a window that shows what the device computes.
  std::vector<std::string> instanceExtensions{}, deviceExtensions{};
  bool wantsGraphics = false;  // the queue draws too
};

/// Memory that a host gives for one buffer.
struct HostAllocation {
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;
  void* mapped = nullptr;  // where the host sees it; of types that can be mapped
  void* own = nullptr;     // the host's
};

/// A host's allocator in place of vkAllocateMemory; both or neither. Any thread that makes buffers calls it.
struct HostAllocator {
  std::function<VkResult(const VkMemoryRequirements&, std::uint32_t type, HostAllocation&)> allocate{};
  std::function<void(const HostAllocation&)> free{};
};

/// A device that a host opened. The host closes it after everything made on it is destroyed.
struct HostDevice {
  PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  std::uint32_t queueFamily = 0;
  std::uint32_t apiVersion = 0;       // of the host's VkApplicationInfo
  bool subgroupSizeControl = false;   // features that the device was opened with
  bool computeFullSubgroups = false;  // likewise
  bool atomicInt64 = false;           // shaderInt64 and shaderBufferInt64Atomics
  std::mutex* queueMutex = nullptr;   // locked during submissions to the queue; null: nobody else submits
  HostAllocator allocator{};
};

/// The extensions and features with which a host should open a device: all that kernels use and it has.
struct DeviceNeeds {
  std::vector<std::string> extensions;
  bool subgroupSizeControl = false;
  bool computeFullSubgroups = false;
  bool atomicInt64 = false;       // shaderInt64 and shaderBufferInt64Atomics
  std::uint32_t queueFamily = 0;  // the best; another that computes will do
};

class Device : public std::enable_shared_from_this<Device> {
 public:
  /// Opens the device `choice` names, by index or by part of its name in any case; an empty choice takes
  /// $RINGLET_DEVICE, else the best usable one (discrete, integrated, virtual, cpu). Where several have the
  /// name, the best of them. RINGLET_VALIDATION=1 turns the validation layer on. `cacheFolder`: where
  /// compiled kernels are kept, if the driver gives them; empty: nowhere. What is wrong with it is no
  /// failure.
  static Result<std::shared_ptr<Device>> open(const std::string& choice = "",
                                              const DeviceOptions& options = {},
                                              const std::filesystem::path& cacheFolder = {});
  /// All devices, by index. Empty where there is no Vulkan.
  static std::vector<DeviceListing> list();
  /// Works on a host's device. Fails if the device or its queue lacks a feature that the solver needs.
  static Result<std::shared_ptr<Device>> adopt(const HostDevice& host,
                                               const std::filesystem::path& cacheFolder = {});
  /// Of a host's instance. Fails where the device cannot run the solver.
  static Result<DeviceNeeds> needs(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance,
                                   VkPhysicalDevice physical, std::uint32_t apiVersion);

  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceProperties& properties() const { return properties_; }
  /// Of a kernel with one invocation a point: 65,535 groups, the least Vulkan promises, are 16 million
  /// points.
  std::uint32_t pointGroupSize() const { return std::min(256u, properties_.maxGroupInvocations); }
  const DeviceOptions& options() const { return options_; }

  /// Fails in another process than the one that opened the device, after fork(): a driver's threads are not
  /// in it, and a wait would never end. What such a process destroys of the device's is left to its end.
  Status checkProcess() const;
  bool isOfThisProcess() const;

  /// Warnings and errors of the validation layer so far; empty where it is off.
  std::vector<std::string> validationMessages() const;
  /// The log behind it, which may be kept past the device; null where the layer is off.
  const std::shared_ptr<ValidationLog>& validationLog() const { return instance_->validationLog(); }

  // For the other files of gpu/.
  const VolkDeviceTable& vk() const { return table_; }
  VkDevice handle() const { return device_; }
  VkInstance instance() const { return instance_->handle(); }
  VkPhysicalDevice physical() const { return physical_; }
  /// Callers that submit to the queue themselves must not do so while others submit.
  VkQueue queue() const { return queue_; }
  const HostAllocator& hostAllocator() const { return hostAllocator_; }
  std::uint32_t queueFamily() const { return queueFamily_; }
  /// The kernels compiled so far.
  KernelCache& kernels() const { return *kernels_; }
  VkPipelineCache pipelineCache() const { return pipelineCache_; }
  /// Where it is kept; empty: nowhere.
  const std::filesystem::path& pipelineCacheFile() const { return pipelineCacheFile_; }
  const VkPhysicalDeviceMemoryProperties& memory() const { return memory_; }
  /// Bytes left in a heap: of this process's budget if the driver states one, else of the whole heap less the
  /// bytes that this device has taken.
  std::uint64_t availableBytes(std::uint32_t heap) const;
  /// Counts bytes of a heap as taken until the returned object is destroyed.
  std::shared_ptr<void> countBytes(std::uint32_t heap, std::uint64_t bytes);
  /// Hands command buffers to the queue, each a submission of its own; the fence is for all. Any thread may.
  VkResult submit(std::span<const VkCommandBuffer> parts, VkFence fence);
  /// Submissions so far.
  std::uint64_t submissionCount() const { return submissionCount_; }
  /// Notes when a wait for a submission ended, and returns when the last one did. Thread-safe.
  std::chrono::steady_clock::time_point noteWait(std::chrono::steady_clock::time_point now);
  /// Names an object for validation messages and capture tools, where the loader has VK_EXT_debug_utils.
  void nameObject(VkObjectType type, std::uint64_t handle, const std::string& name) const;
  /// The same for commands, from the first call to the second.
  void beginLabel(VkCommandBuffer commands, const std::string& name) const;
  void endLabel(VkCommandBuffer commands) const;
  /// All empty without that extension.
  struct DebugCalls {
    PFN_vkSetDebugUtilsObjectNameEXT name = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT begin = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT end = nullptr;
  };
  const DebugCalls& debugCalls() const { return debugCalls_; }

 private:
  Device();
  void take(std::unique_ptr<Instance> instance, VkPhysicalDevice physical, std::uint32_t queueFamily,
            bool hasMemoryBudget, const DeviceProperties& properties);
  Status openPipelineCache(VkPhysicalDevice physical, const std::filesystem::path& folder);
  void keepPipelineCache() const;

  std::unique_ptr<Instance> instance_;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  bool hasMemoryBudget_ = false;
  std::array<std::atomic<std::uint64_t>, VK_MAX_MEMORY_HEAPS> takenBytes_{};
  VkDevice device_ = VK_NULL_HANDLE;
  bool isOwned_ = true;
  VolkDeviceTable table_{};
  VkQueue queue_ = VK_NULL_HANDLE;
  std::mutex ownMutex_;
  std::mutex* queueMutex_ = &ownMutex_;
  HostAllocator hostAllocator_;
  std::atomic<std::uint64_t> submissionCount_ = 0;
  std::chrono::steady_clock::time_point lastWait_{};
  std::uint32_t queueFamily_ = 0;
  std::unique_ptr<KernelCache> kernels_;
  VkPipelineCache pipelineCache_ = VK_NULL_HANDLE;
  std::filesystem::path pipelineCacheFile_;
  PipelineCacheOwner pipelineCacheOwner_;
  std::size_t pipelineCacheBytes_ = 0;  // when it was new
  VkPhysicalDeviceMemoryProperties memory_{};
  DebugCalls debugCalls_;
  DeviceProperties properties_;
  DeviceOptions options_;
  const int process_;  // that opened it
};

}  // namespace ringlet::gpu
