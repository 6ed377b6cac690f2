// Implements gpu/device.h.
#include "ringlet/gpu/device.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "ringlet/gpu/check.h"
#include "ringlet/gpu/device_lack.h"
#include "ringlet/gpu/kernel_cache.h"
#include "ringlet/gpu/pipeline_cache_file.h"
#include "ringlet/gpu/queue_family.h"
#include "ringlet/gpu/subgroup_width.h"

namespace ringlet::gpu {
namespace {

Device::DebugCalls debugCallsOf(VkInstance instance) {
  const auto find = [&](const char* name) { return vkGetInstanceProcAddr(instance, name); };
  return {
      reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(find("vkSetDebugUtilsObjectNameEXT")),
      reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(find("vkCmdBeginDebugUtilsLabelEXT")),
      reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(find("vkCmdEndDebugUtilsLabelEXT")),
  };
}

// Everything opening needs to know of a device, found without opening it.
struct Candidate {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  DeviceListing listing;
  std::uint32_t queueFamily = 0;
  std::vector<const char*> extensions;  // to switch on
  bool hasMemoryBudget = false;
};

std::string_view typeName(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "cpu";
    default:
      return "other";
  }
}

// Smaller is better.
int rank(const DeviceProperties& properties) {
  constexpr std::array<std::string_view, 4> kBestFirst{"discrete", "integrated", "virtual", "cpu"};
  return static_cast<int>(std::find(kBestFirst.begin(), kBestFirst.end(), properties.type) -
                          kBestFirst.begin());
}

std::string versionText(std::uint32_t version) {
  return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                     VK_API_VERSION_PATCH(version));
}

Result<std::vector<VkExtensionProperties>> deviceExtensions(VkPhysicalDevice device) {
  std::vector<VkExtensionProperties> extensions;
  VkResult result = VK_INCOMPLETE;
  while (result == VK_INCOMPLETE) {
    std::uint32_t count = 0;
    RINGLET_VK_CHECK(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr),
                     "list a device's extensions");
    extensions.resize(count);
    result = vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data());
    extensions.resize(count);
  }
  if (result != VK_SUCCESS) {
    return vulkanError("vkEnumerateDeviceExtensionProperties", result, "list a device's extensions");
  }
  return extensions;
}

std::vector<VkQueueFamilyProperties> queueFamilies(VkPhysicalDevice device) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  return families;
}

// Of the device's own heaps; a device without takes the host's.
std::uint64_t memoryOf(VkPhysicalDevice handle) {
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(handle, &memory);
  std::uint64_t own = 0, all = 0;
  for (const VkMemoryHeap& heap : std::span(memory.memoryHeaps, memory.memoryHeapCount)) {
    all += heap.size;
    if (heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) own += heap.size;
  }
  return own > 0 ? own : all;
}

void takeBasics(const VkPhysicalDeviceProperties& basic, const DeviceOptions& options, DeviceProperties& p) {
  p.name = basic.deviceName;
  p.type = typeName(basic.deviceType);
  p.isCpu = basic.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU && !options.asGpu;
  p.driver = "driver version " + versionText(basic.driverVersion);
  p.driverVersion = basic.driverVersion;
  p.vendorId = basic.vendorID;
  p.deviceId = basic.deviceID;
  p.maxStorageBufferRange = basic.limits.maxStorageBufferRange;
  p.maxTexelRecords = basic.limits.maxTexelBufferElements;
  if (options.mostTexelRecords > 0) p.maxTexelRecords = std::min(p.maxTexelRecords, options.mostTexelRecords);
  p.maxUniformBufferRange = basic.limits.maxUniformBufferRange;
  p.maxStorageBuffers = basic.limits.maxPerStageDescriptorStorageBuffers;
  if (options.mostStorageBuffers > 0)
    p.maxStorageBuffers = std::min(p.maxStorageBuffers, options.mostStorageBuffers);
  p.maxGroupCount = basic.limits.maxComputeWorkGroupCount[0];
  p.maxGroupInvocations =
      std::min(basic.limits.maxComputeWorkGroupInvocations, basic.limits.maxComputeWorkGroupSize[0]);
  p.maxPushConstantBytes = basic.limits.maxPushConstantsSize;
  p.maxSharedMemoryBytes = basic.limits.maxComputeSharedMemorySize;
  p.timestampPeriod = basic.limits.timestampPeriod;
}

// What came after Vulkan 1.1 and is known.
struct Known {
  bool driver = false, sizeControl = false, atomics64 = false, inspection = false;
};

struct Answers {
  VkPhysicalDeviceSubgroupProperties subgroup;
  VkPhysicalDeviceMaintenance3Properties memory;
  VkPhysicalDeviceDriverProperties driver;
  VkPhysicalDeviceSubgroupSizeControlProperties size;
  VkPhysicalDeviceFeatures2 features;
  VkPhysicalDeviceSubgroupSizeControlFeatures sizeFeatures;
  VkPhysicalDeviceShaderAtomicInt64Features atomics64;
  VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR inspection;
};

// The rest of the answers is 0.
Answers ask(VkPhysicalDevice handle, const Known& known) {
  Answers a{};
  a.subgroup.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
  a.memory.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
  a.driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  a.size.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES;
  a.features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  a.sizeFeatures.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES;
  a.atomics64.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_ATOMIC_INT64_FEATURES;
  a.inspection.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR;
  auto properties = zeroed<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
  properties.pNext = &a.subgroup;
  a.subgroup.pNext = &a.memory;
  if (known.driver) a.driver.pNext = std::exchange(a.memory.pNext, &a.driver);
  if (known.sizeControl) {
    a.size.pNext = std::exchange(a.memory.pNext, &a.size);
    a.features.pNext = &a.sizeFeatures;
  }
  if (known.atomics64) a.atomics64.pNext = std::exchange(a.features.pNext, &a.atomics64);
  if (known.inspection) a.inspection.pNext = std::exchange(a.features.pNext, &a.inspection);
  vkGetPhysicalDeviceProperties2(handle, &properties);
  vkGetPhysicalDeviceFeatures2(handle, &a.features);
  return a;
}

void takeSubgroups(const Answers& a, const Known& known, const DeviceOptions& options, Candidate& candidate) {
  DeviceProperties& p = candidate.listing.properties;
  p.reportedSubgroupSize = p.minSubgroupSize = p.maxSubgroupSize = a.subgroup.subgroupSize;
  if (known.sizeControl) {
    p.minSubgroupSize = a.size.minSubgroupSize;
    p.maxSubgroupSize = a.size.maxSubgroupSize;
  }
  constexpr VkSubgroupFeatureFlags kShuffle = VK_SUBGROUP_FEATURE_BASIC_BIT | VK_SUBGROUP_FEATURE_SHUFFLE_BIT;
  p.hasSubgroupShuffle = (a.subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0 &&
                         (a.subgroup.supportedOperations & kShuffle) == kShuffle;
  const bool usesSizeControl = known.sizeControl && !options.withoutFullSubgroups;
  p.canChooseSubgroupSize = usesSizeControl && a.sizeFeatures.subgroupSizeControl &&
                            (a.size.requiredSubgroupSizeStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0;
  p.hasFullSubgroups = usesSizeControl && a.sizeFeatures.computeFullSubgroups;
  p.subgroupSize = defaultSubgroupSize(p);
  p.maxGroupSubgroups = usesSizeControl ? a.size.maxComputeWorkgroupSubgroups : 0;
  if ((p.canChooseSubgroupSize || p.hasFullSubgroups) && p.apiVersion < VK_API_VERSION_1_3) {
    candidate.extensions.push_back(VK_EXT_SUBGROUP_SIZE_CONTROL_EXTENSION_NAME);
  }
}

void takeAnswers(const Answers& a, const Known& known, const DeviceOptions& options, Candidate& candidate) {
  DeviceProperties& p = candidate.listing.properties;
  p.hasAtomicInt64 =
      a.features.features.shaderInt64 && a.atomics64.shaderBufferInt64Atomics && !options.withoutAtomicInt64;
  if (p.hasAtomicInt64 && p.apiVersion < VK_API_VERSION_1_2)
    candidate.extensions.push_back(VK_KHR_SHADER_ATOMIC_INT64_EXTENSION_NAME);
  if (known.inspection && a.inspection.pipelineExecutableInfo) {
    p.inspection = options.inspection;
    candidate.extensions.push_back(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
  }

  if (known.driver) {
    p.driver = fmt::format("{} {}", a.driver.driverName, a.driver.driverInfo);
    p.driverId = static_cast<std::uint32_t>(a.driver.driverID);
  }
  p.maxAllocationBytes = a.memory.maxMemoryAllocationSize;
  takeSubgroups(a, known, options, candidate);
}

Candidate inspect(const Instance& instance, VkPhysicalDevice handle, int index,
                  const DeviceOptions& options) {
  Candidate candidate;
  candidate.handle = handle;
  DeviceProperties& p = candidate.listing.properties;

  VkPhysicalDeviceProperties basic;
  vkGetPhysicalDeviceProperties(handle, &basic);
  p.index = index;
  p.memoryBytes = memoryOf(handle);
  p.apiVersion = std::min(basic.apiVersion, instance.apiVersion());
  takeBasics(basic, options, p);
  if (p.apiVersion < kNeededApiVersion) {
    const bool isDrivers = basic.apiVersion < kNeededApiVersion;
    candidate.listing.why =
        fmt::format("{} Vulkan {}, needed is 1.1",
                    isDrivers ? "its driver knows" : "the instance was made for", versionText(p.apiVersion));
    return candidate;
  }

  auto extensions = deviceExtensions(handle);
  if (!extensions) {
    candidate.listing.why = extensions.error().message;
    return candidate;
  }
  const auto has = [&](const char* name) {
    return std::any_of(extensions->begin(), extensions->end(), [&](const VkExtensionProperties& e) {
      return std::strcmp(e.extensionName, name) == 0;
    });
  };
  std::string missing;
  for (const std::string& name : options.deviceExtensions) {
    if (!has(name.c_str())) missing = name;
    candidate.extensions.push_back(name.c_str());
  }
  if (has("VK_KHR_portability_subset"))
    candidate.extensions.push_back("VK_KHR_portability_subset");  // must be switched on where it is

  candidate.hasMemoryBudget = has(VK_EXT_MEMORY_BUDGET_EXTENSION_NAME) &&  // to ask needs no switching on
                              !options.withoutMemoryBudget;
  const Known known{
      .driver = p.apiVersion >= VK_API_VERSION_1_2 || has(VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME),
      .sizeControl = p.apiVersion >= VK_API_VERSION_1_3 || has(VK_EXT_SUBGROUP_SIZE_CONTROL_EXTENSION_NAME),
      .atomics64 = p.apiVersion >= VK_API_VERSION_1_2 || has(VK_KHR_SHADER_ATOMIC_INT64_EXTENSION_NAME),
      .inspection = options.inspection != Inspection::none &&
                    has(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME)};
  takeAnswers(ask(handle, known), known, options, candidate);

  const std::vector<VkQueueFamilyProperties> families = queueFamilies(handle);
  const auto family = chooseComputeFamily(families, options.wantsGraphics);
  if (family) p.timestampBits = families[*family].timestampValidBits;
  p.hasTimestamps = !options.withoutTimestamps && p.timestampBits > 0 && p.timestampPeriod > 0;
  candidate.queueFamily = family.value_or(0);
  candidate.listing.why = !family ? options.wantsGraphics ? "it has no queue that both computes and draws"
                                                          : "it has no compute queue"
                          : !missing.empty() ? fmt::format("it has no {}, which a window needs", missing)
                                             : findLack(p, options);
  candidate.listing.usable = candidate.listing.why.empty();
  return candidate;
}

Result<std::vector<Candidate>> inspectAll(const Instance& instance, const DeviceOptions& options) {
  auto handles = instance.physicalDevices();
  if (!handles) return handles.error();
  std::vector<Candidate> candidates;
  for (VkPhysicalDevice handle : *handles) {
    candidates.push_back(inspect(instance, handle, static_cast<int>(candidates.size()), options));
  }
  return candidates;
}

std::string describe(const std::vector<Candidate>& candidates) {
  std::string text;
  for (const Candidate& candidate : candidates) {
    const DeviceProperties& p = candidate.listing.properties;
    text += fmt::format("\n  {}: {} ({}, {})", p.index, p.name, p.type, p.driver);
    if (!candidate.listing.usable) text += " - not usable: " + candidate.listing.why;
  }
  return text;
}

char toLower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Whether `part` stands in `whole`, in any case.
bool hasPart(std::string_view whole, std::string_view part) {
  return std::search(whole.begin(), whole.end(), part.begin(), part.end(),
                     [](char a, char b) { return toLower(a) == toLower(b); }) != whole.end();
}

const Candidate* best(const std::vector<const Candidate*>& candidates) {
  const auto found =
      std::min_element(candidates.begin(), candidates.end(), [](const Candidate* a, const Candidate* b) {
        const auto key = [](const Candidate* c) {
          return std::pair(!c->listing.usable, rank(c->listing.properties));
        };
        return key(a) < key(b);
      });
  return found == candidates.end() ? nullptr : *found;
}

Result<const Candidate*> pick(const std::vector<Candidate>& candidates, const std::string& choice) {
  const char* fromEnvironment = std::getenv("RINGLET_DEVICE");
  const bool isFromEnvironment = choice.empty() && fromEnvironment && *fromEnvironment;
  const std::string wanted = isFromEnvironment ? fromEnvironment : choice;
  const std::string wantedText =
      fmt::format("'{}'{}", wanted, isFromEnvironment ? " (from $RINGLET_DEVICE)" : "");

  if (candidates.empty()) {
    return Error{
        "no Vulkan device on this machine: the Vulkan loader works, but lists none. Install the driver of "
        "your graphics card, or on Debian mesa-vulkan-drivers, which also runs on the CPU"};
  }

  std::vector<const Candidate*> matches;
  if (wanted.empty()) {
    for (const Candidate& candidate : candidates) matches.push_back(&candidate);
    const Candidate* found = best(matches);
    if (!found->listing.usable)
      return Error{"no Vulkan device of this machine can run Ringlet. Found:" + describe(candidates)};
    return found;
  }

  // A number is an index if there is such a device, and else may be part of a name.
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  const bool isNumber = error == std::errc() && end == wanted.data() + wanted.size();
  if (isNumber && index < candidates.size()) {
    matches.push_back(&candidates[index]);
  } else {
    for (const Candidate& candidate : candidates) {
      if (hasPart(candidate.listing.properties.name, wanted)) matches.push_back(&candidate);
    }
  }
  const Candidate* found = best(matches);
  if (!found) {
    return Error{fmt::format(
        "no Vulkan device matches {}: it is neither an index (0 to {}) nor part of a device's name. "
        "Found:{}\nChoose one of these, or leave the choice out to take the best",
        wantedText, candidates.size() - 1, describe(candidates))};
  }
  if (!found->listing.usable) {
    return Error{fmt::format("the Vulkan device {}, chosen by {}, cannot run Ringlet: {}. Found:{}",
                             found->listing.properties.name, wantedText, found->listing.why,
                             describe(candidates))};
  }
  return found;
}

bool isValidationWanted() {
  const char* value = std::getenv("RINGLET_VALIDATION");
  return value && std::string_view(value) == "1";
}

}  // namespace

std::vector<DeviceListing> Device::list() {
  std::vector<DeviceListing> listings;
  auto instance = Instance::create(false);
  if (!instance) return listings;
  auto candidates = inspectAll(**instance, {});
  if (!candidates) return listings;
  for (const Candidate& candidate : *candidates) listings.push_back(candidate.listing);
  return listings;
}

Result<std::shared_ptr<Device>> Device::open(const std::string& choice, const DeviceOptions& options,
                                             const std::filesystem::path& cacheFolder) {
  auto instance = Instance::create(isValidationWanted(), options.instanceExtensions);
  if (!instance) return instance.error();
  auto candidates = inspectAll(**instance, options);
  if (!candidates) return candidates.error();
  auto picked = pick(*candidates, choice);
  if (!picked) return picked.error();
  const Candidate& candidate = **picked;

  std::shared_ptr<Device> self(new Device);
  self->take(std::move(*instance), candidate.handle, candidate.queueFamily, candidate.hasMemoryBudget,
             candidate.listing.properties);
  self->options_ = options;

  const float priority = 1;
  auto queue = zeroed<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
  queue.queueFamilyIndex = candidate.queueFamily;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;

  auto sizeControl = zeroed<VkPhysicalDeviceSubgroupSizeControlFeatures>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES);
  const DeviceProperties& has = self->properties_;
  sizeControl.subgroupSizeControl = has.canChooseSubgroupSize;
  sizeControl.computeFullSubgroups = has.hasFullSubgroups;

  auto atomics64 = zeroed<VkPhysicalDeviceShaderAtomicInt64Features>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_ATOMIC_INT64_FEATURES);
  atomics64.shaderBufferInt64Atomics = VK_TRUE;
  VkPhysicalDeviceFeatures enabled{};
  enabled.shaderInt64 = has.hasAtomicInt64;

  auto inspection = zeroed<VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR);
  inspection.pipelineExecutableInfo = VK_TRUE;

  auto info = zeroed<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
  info.pNext = has.canChooseSubgroupSize || has.hasFullSubgroups ? &sizeControl : nullptr;
  if (has.hasAtomicInt64) atomics64.pNext = const_cast<void*>(std::exchange(info.pNext, &atomics64));
  info.pEnabledFeatures = &enabled;
  if (has.inspection != Inspection::none)
    inspection.pNext = const_cast<void*>(std::exchange(info.pNext, &inspection));
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = static_cast<std::uint32_t>(candidate.extensions.size());
  info.ppEnabledExtensionNames = candidate.extensions.data();
  RINGLET_VK_CHECK(vkCreateDevice(candidate.handle, &info, nullptr, &self->device_),
                   fmt::format("open the Vulkan device {}", self->properties_.name));

  volkLoadDeviceTable(&self->table_, self->device_);
  self->table_.vkGetDeviceQueue(self->device_, candidate.queueFamily, 0, &self->queue_);
  if (self->instance_->hasDebugUtils()) self->debugCalls_ = debugCallsOf(self->instance_->handle());

  if (Status opened = self->openPipelineCache(candidate.handle, cacheFolder); !opened) return opened.error();
  return self;
}

Result<DeviceNeeds> Device::needs(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance,
                                  VkPhysicalDevice physical, std::uint32_t apiVersion) {
  auto adopted = Instance::adopt(getInstanceProcAddr, instance, apiVersion);
  if (!adopted) return adopted.error();
  const Candidate candidate = inspect(**adopted, physical, 0, {});
  const DeviceProperties& p = candidate.listing.properties;
  if (!candidate.listing.usable)
    return Error{fmt::format("the Vulkan device {} cannot run Ringlet: {}", p.name, candidate.listing.why)};
  return DeviceNeeds{{candidate.extensions.begin(), candidate.extensions.end()},
                     p.canChooseSubgroupSize,
                     p.hasFullSubgroups,
                     p.hasAtomicInt64,
                     candidate.queueFamily};
}

Result<std::shared_ptr<Device>> Device::adopt(const HostDevice& host,
                                              const std::filesystem::path& cacheFolder) {
  auto instance = Instance::adopt(host.getInstanceProcAddr, host.instance, host.apiVersion);
  if (!instance) return instance.error();
  if (!host.physical || !host.device || !host.queue)
    return Error{"a host hands over no physical device, no device or no queue"};
  if (bool(host.allocator.allocate) != bool(host.allocator.free))
    return Error{"a host's allocator either allocates and frees, or does neither"};
  Candidate candidate = inspect(**instance, host.physical, 0, {.withoutAtomicInt64 = !host.atomicInt64});
  DeviceProperties& p = candidate.listing.properties;
  const std::vector<VkQueueFamilyProperties> families = queueFamilies(host.physical);
  if (host.queueFamily >= families.size() || !(families[host.queueFamily].queueFlags & VK_QUEUE_COMPUTE_BIT))
    return Error{fmt::format(
        "the queue that a host hands over is of family {}, which does not compute; {} computes in family {}",
        host.queueFamily, p.name, candidate.queueFamily)};
  if (!candidate.listing.usable)
    return Error{fmt::format("the Vulkan device {} cannot run Ringlet: {}", p.name, candidate.listing.why)};
  p.timestampBits = families[host.queueFamily].timestampValidBits;
  p.hasTimestamps = p.timestampBits > 0 && p.timestampPeriod > 0;
  p.canChooseSubgroupSize = p.canChooseSubgroupSize && host.subgroupSizeControl;
  p.hasFullSubgroups = p.hasFullSubgroups && host.computeFullSubgroups;
  p.subgroupSize = defaultSubgroupSize(p);

  std::shared_ptr<Device> self(new Device);
  self->isOwned_ = false;
  self->take(std::move(*instance), host.physical, host.queueFamily, candidate.hasMemoryBudget, p);
  self->device_ = host.device;
  if (host.queueMutex) self->queueMutex_ = host.queueMutex;
  self->hostAllocator_ = host.allocator;
  volkLoadDeviceTable(&self->table_, self->device_);
  self->queue_ = host.queue;
  if (Status opened = self->openPipelineCache(host.physical, cacheFolder); !opened) return opened.error();
  return self;
}

// With what the file of this device and driver holds. A driver takes nothing that is not its own; one that
// refuses it altogether gets an empty cache.
Status Device::openPipelineCache(VkPhysicalDevice physical, const std::filesystem::path& folder) {
  std::vector<std::byte> kept;
  if (!folder.empty()) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical, &properties);
    pipelineCacheOwner_ = {properties.vendorID, properties.deviceID, properties.driverVersion,
                           std::to_array(properties.pipelineCacheUUID)};
    std::string uuid;
    for (std::uint8_t byte : pipelineCacheOwner_.uuid) uuid += fmt::format("{:02x}", byte);
    pipelineCacheFile_ = folder / fmt::format("pipelines-{}.bin", uuid);
    kept = readPipelineCache(pipelineCacheFile_, pipelineCacheOwner_);
  }
  auto info = zeroed<VkPipelineCacheCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO);
  info.initialDataSize = kept.size();
  info.pInitialData = kept.data();
  if (kept.empty() || vk().vkCreatePipelineCache(device_, &info, nullptr, &pipelineCache_) != VK_SUCCESS) {
    info.initialDataSize = 0;
    RINGLET_VK_CHECK(vk().vkCreatePipelineCache(device_, &info, nullptr, &pipelineCache_),
                     "make a cache for compiled kernels");
  }
  // An empty one is its header; some drivers never have more.
  if (vk().vkGetPipelineCacheData(device_, pipelineCache_, &pipelineCacheBytes_, nullptr) != VK_SUCCESS)
    pipelineCacheBytes_ = kLargestPipelineCache;
  return {};
}

// Only where it grew.
void Device::keepPipelineCache() const {
  std::size_t size = 0;
  if (pipelineCacheFile_.empty() ||
      vk().vkGetPipelineCacheData(device_, pipelineCache_, &size, nullptr) != VK_SUCCESS ||
      size <= pipelineCacheBytes_ || size > kLargestPipelineCache)
    return;
  std::vector<std::byte> bytes(size);
  if (vk().vkGetPipelineCacheData(device_, pipelineCache_, &size, bytes.data()) != VK_SUCCESS) return;
  bytes.resize(size);
  (void)writePipelineCache(pipelineCacheFile_, pipelineCacheOwner_, bytes);
}

void Device::take(std::unique_ptr<Instance> instance, VkPhysicalDevice physical, std::uint32_t queueFamily,
                  bool hasMemoryBudget, const DeviceProperties& properties) {
  instance_ = std::move(instance);
  physical_ = physical;
  queueFamily_ = queueFamily;
  hasMemoryBudget_ = hasMemoryBudget;
  properties_ = properties;
  vkGetPhysicalDeviceMemoryProperties(physical, &memory_);
}

Device::Device() : kernels_(std::make_unique<KernelCache>()), process_(getpid()) {}

Device::~Device() {
  if (!isOfThisProcess()) static_cast<void>(instance_.release());
  if (!device_) return;
  if (!isOfThisProcess()) {
    static_cast<void>(kernels_.release());
    return;
  }
  keepPipelineCache();
  kernels_.reset();
  table_.vkDestroyPipelineCache(device_, pipelineCache_, nullptr);
  if (isOwned_) table_.vkDestroyDevice(device_, nullptr);
}

bool Device::isOfThisProcess() const { return process_ == getpid(); }

Status Device::checkProcess() const {
  if (isOfThisProcess()) return {};
  return Error{fmt::format(
      "{} was opened by process {}, and this is process {}, after fork(): a device and all that was made "
      "with it are of use in their own process only. Open a device in this one",
      properties_.name, process_, getpid())};
}

std::vector<std::string> Device::validationMessages() const {
  return validationLog() ? validationLog()->messages() : std::vector<std::string>{};
}

std::uint64_t Device::availableBytes(std::uint32_t heap) const {
  std::uint64_t whole = memory_.memoryHeaps[heap].size, taken = takenBytes_[heap];
  if (hasMemoryBudget_) {
    auto budget = zeroed<VkPhysicalDeviceMemoryBudgetPropertiesEXT>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT);
    auto memory =
        zeroed<VkPhysicalDeviceMemoryProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2);
    memory.pNext = &budget;
    vkGetPhysicalDeviceMemoryProperties2(physical_, &memory);
    whole = std::min<std::uint64_t>(whole, budget.heapBudget[heap]);
    taken = std::max<std::uint64_t>(taken, budget.heapUsage[heap]);
  }
  return whole - std::min(whole, taken);
}

std::shared_ptr<void> Device::countBytes(std::uint32_t heap, std::uint64_t bytes) {
  takenBytes_[heap] += bytes;
  return {this, [self = shared_from_this(), heap, bytes](void*) { self->takenBytes_[heap] -= bytes; }};
}

// One call a part: drivers may take what comes in one call for one job, and a watchdog counts jobs.
VkResult Device::submit(std::span<const VkCommandBuffer> parts, VkFence fence) {
  const std::lock_guard lock(*queueMutex_);
  for (const VkCommandBuffer& part : parts) {
    auto info = zeroed<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    info.commandBufferCount = 1;
    info.pCommandBuffers = &part;
    const bool isLast = &part == &parts.back();
    const VkResult result = table_.vkQueueSubmit(queue_, 1, &info, isLast ? fence : VK_NULL_HANDLE);
    if (result != VK_SUCCESS) {
      (void)table_.vkQueueWaitIdle(queue_);  // no fence tells when the parts before are done
      return result;
    }
    ++submissionCount_;
  }
  return VK_SUCCESS;
}

std::chrono::steady_clock::time_point Device::noteWait(std::chrono::steady_clock::time_point now) {
  const std::lock_guard lock(ownMutex_);
  return std::exchange(lastWait_, now);
}

void Device::nameObject(VkObjectType type, std::uint64_t handle, const std::string& name) const {
  if (!debugCalls_.name) return;
  auto info = zeroed<VkDebugUtilsObjectNameInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT);
  info.objectType = type;
  info.objectHandle = handle;
  info.pObjectName = name.c_str();
  debugCalls_.name(device_, &info);  // a name that fails to stick is no loss
}

void Device::beginLabel(VkCommandBuffer commands, const std::string& name) const {
  if (!debugCalls_.begin) return;
  auto label = zeroed<VkDebugUtilsLabelEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT);
  label.pLabelName = name.c_str();
  debugCalls_.begin(commands, &label);
}

void Device::endLabel(VkCommandBuffer commands) const {
  if (debugCalls_.end) debugCalls_.end(commands);
}

}  // namespace ringlet::gpu
