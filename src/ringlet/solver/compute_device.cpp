// Implements solver/compute_device.h over gpu/device.h.
#include "ringlet/solver/compute_device.h"

#include <algorithm>

#include "ringlet/gpu/device.h"
#include "ringlet/solver/plan/subgroup_choice.h"
#include "ringlet/solver/strands/strand_kernels.h"

namespace ringlet {
namespace {

// True of lavapipe's compiler. A CPU device whose driver does not state its name counts as lavapipe.
bool endsLoopsEarly(const gpu::DeviceProperties& p) {
  return p.driverId == VK_DRIVER_ID_MESA_LLVMPIPE || (p.driverId == 0 && p.type == "cpu");
}

// Longer runs in memory make NVIDIA's compiler fail (580.159, H200). With bodies 32 compiles and 33 does not;
// for hair alone 48 does and 50 does not, whatever the number of lanes.
constexpr std::uint32_t kLongestRunInMemoryOfNvidia = 32;

DeviceLimits limitsOf(const gpu::DeviceProperties& p) {
  DeviceLimits limits;
  // A strand must fit a workgroup too, whatever the width of a subgroup.
  limits.subgroupSize = std::min(p.subgroupSize, kStrandGroupSize);
  limits.hasSubgroupShuffle = p.hasSubgroupShuffle;
  limits.isCpu = p.isCpu;
  limits.maxGroupCount = p.maxGroupCount;
  if (p.driverId == VK_DRIVER_ID_NVIDIA_PROPRIETARY) limits.longestRunInMemory = kLongestRunInMemoryOfNvidia;
  limits.endsLoopsEarly = endsLoopsEarly(p);
  if (p.canChooseSubgroupSize) {
    limits.minSubgroupSize = p.minSubgroupSize;
    limits.maxSubgroupSize = std::min(p.maxSubgroupSize, kStrandGroupSize);
  }
  return limits;
}

PFN_vkGetInstanceProcAddr loaderOf(const HostVulkan& host) {
  return reinterpret_cast<PFN_vkGetInstanceProcAddr>(host.getInstanceProcAddr);
}

gpu::HostAllocator allocatorOf(const HostVulkan& host) {
  gpu::HostAllocator allocator;
  if (host.allocate) {
    allocator.allocate = [allocate = host.allocate](const VkMemoryRequirements& wanted, std::uint32_t type,
                                                    gpu::HostAllocation& piece) {
      HostMemory given;
      const auto result = static_cast<VkResult>(allocate(wanted.size, wanted.alignment, type, given));
      piece = {reinterpret_cast<VkDeviceMemory>(given.memory), given.offset, given.mapped, given.own};
      return result;
    };
  }
  if (host.free) {
    allocator.free = [free = host.free](const gpu::HostAllocation& piece) {
      free({reinterpret_cast<void*>(piece.memory), piece.offset, piece.mapped, piece.own});
    };
  }
  return allocator;
}

}  // namespace

Result<ComputeDevice> ComputeDevice::open(const std::string& choice,
                                          const std::filesystem::path& cacheFolder) {
  auto opened = gpu::Device::open(choice, {}, cacheFolder);
  if (!opened) return opened.error();
  return over(std::move(*opened));
}

Result<ComputeDevice> ComputeDevice::adopt(const HostVulkan& host, const std::filesystem::path& cacheFolder) {
  auto adopted = gpu::Device::adopt({.getInstanceProcAddr = loaderOf(host),
                                     .instance = static_cast<VkInstance>(host.instance),
                                     .physical = static_cast<VkPhysicalDevice>(host.physicalDevice),
                                     .device = static_cast<VkDevice>(host.device),
                                     .queue = static_cast<VkQueue>(host.queue),
                                     .queueFamily = host.queueFamily,
                                     .apiVersion = host.apiVersion,
                                     .subgroupSizeControl = host.subgroupSizeControl,
                                     .computeFullSubgroups = host.computeFullSubgroups,
                                     .atomicInt64 = host.atomicInt64,
                                     .queueMutex = host.queueMutex,
                                     .allocator = allocatorOf(host)},
                                    cacheFolder);
  if (!adopted) return adopted.error();
  return over(std::move(*adopted));
}

Result<HostVulkanNeeds> ComputeDevice::needs(const HostVulkan& host) {
  auto needs = gpu::Device::needs(loaderOf(host), static_cast<VkInstance>(host.instance),
                                  static_cast<VkPhysicalDevice>(host.physicalDevice), host.apiVersion);
  if (!needs) return needs.error();
  return HostVulkanNeeds{std::move(needs->extensions), needs->subgroupSizeControl,
                         needs->computeFullSubgroups, needs->atomicInt64, needs->queueFamily};
}

ComputeDevice ComputeDevice::over(std::shared_ptr<gpu::Device> device) {
  ComputeDevice self;
  self.device_ = std::move(device);
  return self;
}

std::vector<DeviceSummary> ComputeDevice::list() {
  std::vector<DeviceSummary> summaries;
  for (const gpu::DeviceListing& listing : gpu::Device::list()) {
    const gpu::DeviceProperties& p = listing.properties;
    summaries.push_back({p.index, p.name, p.type, p.driver, p.memoryBytes, p.reportedSubgroupSize,
                         subgroupSizes(limitsOf(p)), listing.usable, listing.why});
  }
  return summaries;
}

std::string ComputeDevice::name() const { return device_->properties().name; }
std::string ComputeDevice::driver() const { return device_->properties().driver; }
Status ComputeDevice::checkProcess() const { return device_->checkProcess(); }
DeviceLimits ComputeDevice::limits() const { return limitsOf(device_->properties()); }
std::vector<std::string> ComputeDevice::validationMessages() const { return device_->validationMessages(); }

}  // namespace ringlet
