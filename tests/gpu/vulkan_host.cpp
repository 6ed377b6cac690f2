// Implements gpu/vulkan_host.h.
#include "tests/gpu/vulkan_host.h"

#include <dlfcn.h>

#include <array>
#include <cstring>

#include "ringlet_shaders/scale_values_test.h"

namespace ringlet::test {
namespace {

VKAPI_ATTR VkBool32 VKAPI_CALL keep(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                    const VkDebugUtilsMessengerCallbackDataEXT* data, void* messages) {
  static_cast<std::vector<std::string>*>(messages)->emplace_back(data->pMessage);
  return VK_FALSE;
}

}  // namespace

#define CALL(name) calls_.call<PFN_##name>(#name)

Host::Host(bool asksForNeeds) {
  void* library = dlopen("libvulkan.so.1", RTLD_NOW);
  calls_.get = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));
  makeInstance();
  std::uint32_t count = 1;
  CALL(vkEnumeratePhysicalDevices)(calls_.instance, &count, &physical_);
  handles_ = {.getInstanceProcAddr = reinterpret_cast<void*>(calls_.get),
              .instance = calls_.instance,
              .physicalDevice = physical_,
              .apiVersion = kVersion};
  const auto needs = ComputeDevice::needs(handles_);
  EXPECT_TRUE(needs) << needs.error().message;
  handles_.queueFamily = needs->queueFamily;
  makeDevice(asksForNeeds ? *needs : HostVulkanNeeds{});
}

Host::~Host() {
  CALL(vkDestroyDevice)(device_, nullptr);
  CALL(vkDestroyDebugUtilsMessengerEXT)(calls_.instance, messenger_, nullptr);
  CALL(vkDestroyInstance)(calls_.instance, nullptr);
}

void Host::drop(const Owned& owned) {
  CALL(vkDestroyBuffer)(device_, owned.buffer, nullptr);
  CALL(vkFreeMemory)(device_, owned.memory, nullptr);
}

Host::Written Host::write(const std::vector<float>& numbers) {
  constexpr std::size_t kMost = 16384;  // numbers of an update
  Written written;
  written.owned = makeBuffer(numbers.size() * sizeof(float),
                             VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  written.work = submit([&](VkCommandBuffer commands) {
    for (std::size_t at = 0; at < numbers.size(); at += kMost) CALL(vkCmdUpdateBuffer)
    (commands, written.owned.buffer, at * sizeof(float), std::min(kMost, numbers.size() - at) * sizeof(float),
     &numbers[at]);
  });
  return written;
}

void Host::drop(const Written& written) {
  wait(written.work);
  drop(written.owned);
}

void Host::makeInstance() {
  const VkValidationFeatureEnableEXT synchronisation =
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  const VkDebugUtilsMessengerCreateInfoEXT messenger{
      .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
      .pNext = nullptr,
      .flags = 0,
      .messageSeverity =
          VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
      .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
      .pfnUserCallback = keep,
      .pUserData = messages_.get()};
  const VkValidationFeaturesEXT features{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                         .pNext = &messenger,
                                         .enabledValidationFeatureCount = 1,
                                         .pEnabledValidationFeatures = &synchronisation,
                                         .disabledValidationFeatureCount = 0,
                                         .pDisabledValidationFeatures = nullptr};
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.apiVersion = kVersion;
  const char* layer = "VK_LAYER_KHRONOS_validation";
  const std::array extensions{VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pNext = &features;
  info.pApplicationInfo = &application;
  info.enabledLayerCount = 1;
  info.ppEnabledLayerNames = &layer;
  info.enabledExtensionCount = extensions.size();
  info.ppEnabledExtensionNames = extensions.data();
  ASSERT_EQ(CALL(vkCreateInstance)(&info, nullptr, &calls_.instance), VK_SUCCESS);
  CALL(vkCreateDebugUtilsMessengerEXT)(calls_.instance, &messenger, nullptr, &messenger_);
}

void Host::makeDevice(const HostVulkanNeeds& needs) {
  const float priority = 1;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = handles_.queueFamily;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkPhysicalDeviceSubgroupSizeControlFeatures sizes{};
  sizes.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES;
  sizes.subgroupSizeControl = needs.subgroupSizeControl;
  sizes.computeFullSubgroups = needs.computeFullSubgroups;
  std::vector<const char*> extensions;
  for (const std::string& extension : needs.extensions) extensions.push_back(extension.c_str());
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = needs.subgroupSizeControl || needs.computeFullSubgroups ? &sizes : nullptr;
  VkPhysicalDeviceShaderAtomicInt64Features atomics{};
  atomics.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_ATOMIC_INT64_FEATURES;
  atomics.shaderBufferInt64Atomics = VK_TRUE;
  VkPhysicalDeviceFeatures enabled{};
  enabled.shaderInt64 = needs.atomicInt64;
  if (needs.atomicInt64) {
    atomics.pNext = const_cast<void*>(info.pNext);
    info.pNext = &atomics;
  }
  info.pEnabledFeatures = &enabled;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  ASSERT_EQ(CALL(vkCreateDevice)(physical_, &info, nullptr, &device_), VK_SUCCESS);
  CALL(vkGetDeviceQueue)(device_, handles_.queueFamily, 0, &queue_);
  handles_.device = device_;
  handles_.queue = queue_;
  handles_.subgroupSizeControl = needs.subgroupSizeControl;
  handles_.computeFullSubgroups = needs.computeFullSubgroups;
  handles_.atomicInt64 = needs.atomicInt64;
  handles_.queueMutex = &queueMutex_;
}

Host::Owned Host::makeBuffer(std::uint64_t bytes, VkBufferUsageFlags usage) {
  Owned owned;
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = bytes;
  info.usage = usage;
  CALL(vkCreateBuffer)(device_, &info, nullptr, &owned.buffer);
  VkMemoryRequirements wants;
  CALL(vkGetBufferMemoryRequirements)(device_, owned.buffer, &wants);
  VkPhysicalDeviceMemoryProperties memory;
  CALL(vkGetPhysicalDeviceMemoryProperties)(physical_, &memory);
  constexpr VkMemoryPropertyFlags kSeen =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  VkMemoryAllocateInfo allocation{};
  allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  allocation.allocationSize = wants.size;
  for (std::uint32_t type = memory.memoryTypeCount; type-- > 0;) {
    if ((wants.memoryTypeBits >> type & 1) && (memory.memoryTypes[type].propertyFlags & kSeen) == kSeen)
      allocation.memoryTypeIndex = type;
  }
  CALL(vkAllocateMemory)(device_, &allocation, nullptr, &owned.memory);
  CALL(vkBindBufferMemory)(device_, owned.buffer, owned.memory, 0);
  CALL(vkMapMemory)(device_, owned.memory, 0, VK_WHOLE_SIZE, 0, &owned.mapped);
  std::memset(owned.mapped, 0, bytes);
  return owned;
}

VkResult Host::allocate(std::uint64_t bytes, std::uint32_t type, VkDeviceMemory& memory, std::byte*& mapped) {
  VkPhysicalDeviceMemoryProperties types;
  CALL(vkGetPhysicalDeviceMemoryProperties)(physical_, &types);
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.allocationSize = bytes;
  info.memoryTypeIndex = type;
  if (const VkResult result = CALL(vkAllocateMemory)(device_, &info, nullptr, &memory); result != VK_SUCCESS)
    return result;
  if (!(types.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT)) return VK_SUCCESS;
  void* address = nullptr;
  const VkResult result = CALL(vkMapMemory)(device_, memory, 0, VK_WHOLE_SIZE, 0, &address);
  mapped = static_cast<std::byte*>(address);
  return result;
}
void Host::free(VkDeviceMemory memory) { CALL(vkFreeMemory)(device_, memory, nullptr); }

HostPool::~HostPool() {
  for (const auto& [type, block] : blocks_) host_->free(block.memory);
}

void HostPool::serve(HostVulkan& handles) {
  handles.allocate = [this](auto bytes, auto alignment, auto type, HostMemory& piece) {
    return allocate(bytes, alignment, type, piece);
  };
  handles.free = [this](const HostMemory& piece) {
    const std::scoped_lock lock(mutex_);
    EXPECT_EQ(kept_.erase(piece.own), 1u) << "a piece comes back that was not given";
  };
}

int HostPool::allocate(std::uint64_t bytes, std::uint64_t alignment, std::uint32_t type, HostMemory& piece) {
  const std::scoped_lock lock(mutex_);
  Block& block = blocks_[type];
  if (!block.memory) {
    const VkResult result = host_->allocate(bytes_, type, block.memory, block.mapped);
    if (result != VK_SUCCESS) return result;
  }
  const std::uint64_t offset = (block.used + alignment - 1) / alignment * alignment;
  if (offset + bytes > bytes_) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  block.used = offset + bytes;
  void* const own = reinterpret_cast<void*>(++given_);
  kept_.insert(own);
  piece = {reinterpret_cast<void*>(block.memory), offset, block.mapped ? block.mapped + offset : nullptr,
           own};
  return VK_SUCCESS;
}

Host::Work Host::submit(const Record& record) {
  Work work;
  VkCommandPoolCreateInfo commandInfo{};
  commandInfo.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  commandInfo.queueFamilyIndex = handles_.queueFamily;
  CALL(vkCreateCommandPool)(device_, &commandInfo, nullptr, &work.pool);
  VkCommandBufferAllocateInfo allocateCommands{};
  allocateCommands.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  allocateCommands.commandPool = work.pool;
  allocateCommands.commandBufferCount = 1;
  VkCommandBuffer commands;
  CALL(vkAllocateCommandBuffers)(device_, &allocateCommands, &commands);
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  CALL(vkBeginCommandBuffer)(commands, &begin);
  record(commands);
  CALL(vkEndCommandBuffer)(commands);
  VkFenceCreateInfo fenceInfo{};
  fenceInfo.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  CALL(vkCreateFence)(device_, &fenceInfo, nullptr, &work.fence);
  VkSubmitInfo submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  {
    const std::lock_guard lock(queueMutex_);
    CALL(vkQueueSubmit)(queue_, 1, &submit, work.fence);
  }
  return work;
}

void Host::wait(const Work& work) {
  CALL(vkWaitForFences)(device_, 1, &work.fence, VK_TRUE, ~0ull);
  CALL(vkDestroyFence)(device_, work.fence, nullptr);
  CALL(vkDestroyCommandPool)(device_, work.pool, nullptr);
}

constexpr std::uint32_t kGroupSize = 64;
constexpr VkDescriptorType kKinds[] = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                       VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER};

Host::Kernel Host::makeKernel() {
  Kernel kernel{};
  std::array<VkDescriptorSetLayoutBinding, 3> bindings{};
  for (std::uint32_t b = 0; b < 3; ++b) bindings[b] = {b, kKinds[b], 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  VkDescriptorSetLayoutCreateInfo setInfo{};
  setInfo.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  setInfo.bindingCount = 3;
  setInfo.pBindings = bindings.data();
  CALL(vkCreateDescriptorSetLayout)(device_, &setInfo, nullptr, &kernel.setLayout);
  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, 8};
  VkPipelineLayoutCreateInfo layoutInfo{};
  layoutInfo.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  layoutInfo.setLayoutCount = 1;
  layoutInfo.pSetLayouts = &kernel.setLayout;
  layoutInfo.pushConstantRangeCount = 1;
  layoutInfo.pPushConstantRanges = &push;
  CALL(vkCreatePipelineLayout)(device_, &layoutInfo, nullptr, &kernel.layout);

  VkShaderModuleCreateInfo moduleInfo{};
  moduleInfo.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  moduleInfo.codeSize = sizeof(k_scale_values_test);
  moduleInfo.pCode = k_scale_values_test;
  CALL(vkCreateShaderModule)(device_, &moduleInfo, nullptr, &kernel.module);
  const VkSpecializationMapEntry entry{0, 0, 4};
  const VkSpecializationInfo special{1, &entry, 4, &kGroupSize};
  VkComputePipelineCreateInfo pipelineInfo{};
  pipelineInfo.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  pipelineInfo.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  pipelineInfo.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  pipelineInfo.stage.module = kernel.module;
  pipelineInfo.stage.pName = "main";
  pipelineInfo.stage.pSpecializationInfo = &special;
  pipelineInfo.layout = kernel.layout;
  CALL(vkCreateComputePipelines)(device_, VK_NULL_HANDLE, 1, &pipelineInfo, nullptr, &kernel.pipeline);
  return kernel;
}

void Host::bind(Kernel& kernel, const std::array<VkDescriptorBufferInfo, 3>& buffers) {
  std::array<VkWriteDescriptorSet, 3> writes{};
  const std::array<VkDescriptorPoolSize, 2> sizes{
      {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2}, {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1}}};
  VkDescriptorPoolCreateInfo poolInfo{};
  poolInfo.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  poolInfo.maxSets = 1;
  poolInfo.poolSizeCount = 2;
  poolInfo.pPoolSizes = sizes.data();
  CALL(vkCreateDescriptorPool)(device_, &poolInfo, nullptr, &kernel.pool);
  VkDescriptorSetAllocateInfo allocateSet{};
  allocateSet.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  allocateSet.descriptorPool = kernel.pool;
  allocateSet.descriptorSetCount = 1;
  allocateSet.pSetLayouts = &kernel.setLayout;
  CALL(vkAllocateDescriptorSets)(device_, &allocateSet, &kernel.set);
  for (std::uint32_t b = 0; b < 3; ++b) {
    writes[b] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                 nullptr,
                 kernel.set,
                 b,
                 0,
                 1,
                 kKinds[b],
                 nullptr,
                 &buffers[b],
                 nullptr};
  }
  CALL(vkUpdateDescriptorSets)(device_, 3, writes.data(), 0, nullptr);
}

void Host::drop(const Kernel& kernel) {
  CALL(vkDestroyDescriptorPool)(device_, kernel.pool, nullptr);
  CALL(vkDestroyPipeline)(device_, kernel.pipeline, nullptr);
  CALL(vkDestroyShaderModule)(device_, kernel.module, nullptr);
  CALL(vkDestroyPipelineLayout)(device_, kernel.layout, nullptr);
  CALL(vkDestroyDescriptorSetLayout)(device_, kernel.setLayout, nullptr);
}

std::vector<std::uint32_t> Host::read(VkBuffer source, std::uint64_t bytes, const Record& before) {
  const Owned target = makeBuffer(bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const Owned shift = makeBuffer(16, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
  Kernel kernel = makeKernel();
  bind(kernel, {{{source, 0, bytes}, {target.buffer, 0, bytes}, {shift.buffer, 0, 16}}});

  const auto count = static_cast<std::uint32_t>(bytes / 4);
  const auto record = [&](VkCommandBuffer commands) {
    before(commands);
    // As DevicePositions asks for.
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT;
    CALL(vkCmdPipelineBarrier)
    (commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 1, &barrier, 0,
     nullptr, 0, nullptr);
    CALL(vkCmdBindPipeline)(commands, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.pipeline);
    CALL(vkCmdBindDescriptorSets)
    (commands, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.layout, 0, 1, &kernel.set, 0, nullptr);
    const std::array<std::uint32_t, 2> countAndFactor{count, 1};
    CALL(vkCmdPushConstants)
    (commands, kernel.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, 8, countAndFactor.data());
    CALL(vkCmdDispatch)(commands, (count + kGroupSize - 1) / kGroupSize, 1, 1);
  };
  wait(submit(record));
  std::vector<std::uint32_t> values(count);
  std::memcpy(values.data(), target.mapped, bytes);
  drop(kernel);
  drop(target);
  drop(shift);
  return values;
}

}  // namespace ringlet::test
