// Implements gpu/kernel.h.
#include "ringlet/gpu/kernel.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "ringlet/base/assert.h"
#include "ringlet/gpu/check.h"
#include "ringlet/gpu/kernel_cache.h"
#include "ringlet/gpu/subgroup_width.h"

namespace ringlet::gpu {
namespace {

VkDescriptorType descriptorType(BindingKind kind) {
  switch (kind) {
    case BindingKind::storage:
      return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    case BindingKind::uniform:
      return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case BindingKind::texels:
      return VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
  }
  return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

std::uint32_t countOf(const std::vector<KernelBinding>& bindings, BindingKind kind) {
  return static_cast<std::uint32_t>(std::ranges::count(bindings, kind, &KernelBinding::kind));
}

// The buffer's records as texels, as many as the device sees.
std::pair<VkResult, OwnedBufferView> viewOf(Device& device, const Buffer& buffer) {
  auto info = zeroed<VkBufferViewCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO);
  info.buffer = buffer.handle();
  info.format = VK_FORMAT_R32G32B32A32_UINT;
  info.range = std::min(buffer.capacity(), device.properties().maxTexelRecords * kRecordBytes);
  VkBufferView view = VK_NULL_HANDLE;
  const VkResult result = device.vk().vkCreateBufferView(device.handle(), &info, nullptr, &view);
  return {result, OwnedBufferView(device.shared_from_this(), view)};
}

std::string attemptTo(const KernelDescription& description, const DeviceProperties& limits) {
  return fmt::format("make the kernel '{}' on {}", description.name, limits.name);
}

// Of the limits it could break, before the driver is asked.
Status checkLimits(const KernelDescription& description, std::uint32_t storageCount,
                   const DeviceProperties& limits) {
  const auto tooMuch = [&](std::uint32_t needed, const char* what, std::uint32_t limit) {
    return Error{fmt::format("could not {}: it needs {} {}, the device has {}",
                             attemptTo(description, limits), needed, what, limit)};
  };
  if (storageCount > limits.maxStorageBuffers) {
    Error error = tooMuch(storageCount, "storage buffers (maxPerStageDescriptorStorageBuffers)",
                          limits.maxStorageBuffers);
    if (!description.remedy.empty()) error.message += "; " + description.remedy;
    return error;
  }
  if (description.groupSize > limits.maxGroupInvocations) {
    return tooMuch(description.groupSize, "invocations in a workgroup (maxComputeWorkGroupInvocations)",
                   limits.maxGroupInvocations);
  }
  if (description.pushConstantBytes > limits.maxPushConstantBytes) {
    return tooMuch(description.pushConstantBytes, "bytes of push constants (maxPushConstantsSize)",
                   limits.maxPushConstantBytes);
  }
  return {};
}

Error tooLargeUniform(const Buffer& buffer, std::uint64_t limit, const std::string& attempt) {
  return Error{fmt::format(
      "could not {}: the buffer '{}' of {} bytes is too large for a uniform, of which this device allows {} "
      "(maxUniformBufferRange)",
      attempt, buffer.name(), buffer.bytes(), limit)};
}

}  // namespace

Result<std::shared_ptr<const Kernel>> Kernel::create(Device& device, const KernelDescription& asked) {
  RINGLET_ASSERT(!asked.spirv.empty(), "a kernel without code");
  KernelDescription description = asked;
  std::vector<std::uint32_t> changed;
  if (device.options().changeCode) {
    changed.assign(asked.spirv.begin(), asked.spirv.end());
    device.options().changeCode(asked.name, changed);
    description.spirv = changed;
  }
  auto kernel = device.kernels().findOrCompile(description, [&] { return compile(device, description); });
  if (!kernel) return kernel;
  return std::shared_ptr<const Kernel>(device.shared_from_this(), kernel->get());
}

bool Kernel::isCompiled(const Device& device, const KernelDescription& description) {
  return device.kernels().has(description);
}

Result<std::shared_ptr<const Kernel>> Kernel::compile(Device& device, const KernelDescription& description) {
  RINGLET_ASSERT(description.pushConstantBytes % 4 == 0, "push constants come in units of 4 bytes");
  const DeviceProperties& limits = device.properties();
  std::vector<KernelBinding> bindings = bindingsOf(description.spirv);
  if (Status fits = checkLimits(description, countOf(bindings, BindingKind::storage), limits); !fits)
    return fits.error();

  const std::shared_ptr<Kernel> kernel(new Kernel);
  Kernel& self = *kernel;
  self.device_ = &device;
  self.name_ = description.name;
  self.bindings_ = std::move(bindings);
  self.pushConstantBytes_ = description.pushConstantBytes;
  self.groupSize_ = description.groupSize;
  const std::uint32_t width = description.subgroupSize ? description.subgroupSize : limits.subgroupSize;
  RINGLET_ASSERT(hasSubgroupSize(limits, width), "a subgroup width the device does not have");
  const bool fitsGroup = description.groupSize <= std::uint64_t{width} * limits.maxGroupSubgroups;
  const bool asksForWidth = description.wantsFullSubgroups && limits.canChooseSubgroupSize && fitsGroup;
  self.subgroupSize_ = width;
  self.hasFullSubgroups_ = description.wantsFullSubgroups && limits.hasFullSubgroups && fitsGroup &&
                           description.groupSize % width == 0;
  if (Status made = self.makeLayout(description); !made) return made.error();
  if (Status made = self.makePipeline(description, asksForWidth); !made) return made.error();
  return std::shared_ptr<const Kernel>(kernel);
}

Status Kernel::makeLayout(const KernelDescription& description) {
  const std::shared_ptr<Device> keeper = keptByDevice(*device_);
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (const auto& [number, kind] : bindings_) {
    VkDescriptorSetLayoutBinding binding{};
    binding.binding = number;
    binding.descriptorType = descriptorType(kind);
    binding.descriptorCount = 1;
    binding.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
    bindings.push_back(binding);
  }
  auto setInfo = zeroed<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  setInfo.bindingCount = static_cast<std::uint32_t>(bindings.size());
  setInfo.pBindings = bindings.data();
  VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
  RINGLET_VK_CHECK(
      device_->vk().vkCreateDescriptorSetLayout(device_->handle(), &setInfo, nullptr, &setLayout),
      attemptTo(description, device_->properties()));
  setLayout_ = OwnedSetLayout(keeper, setLayout);

  VkPushConstantRange range{};
  range.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
  range.size = description.pushConstantBytes;
  auto layoutInfo = zeroed<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  layoutInfo.setLayoutCount = 1;
  layoutInfo.pSetLayouts = &setLayout;
  layoutInfo.pushConstantRangeCount = range.size > 0 ? 1 : 0;
  layoutInfo.pPushConstantRanges = &range;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  RINGLET_VK_CHECK(device_->vk().vkCreatePipelineLayout(device_->handle(), &layoutInfo, nullptr, &layout),
                   attemptTo(description, device_->properties()));
  layout_ = OwnedPipelineLayout(keeper, layout);
  return {};
}

Status Kernel::makePipeline(const KernelDescription& description, bool asksForWidth) {
  const std::shared_ptr<Device> keeper = keptByDevice(*device_);
  auto moduleInfo = zeroed<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
  moduleInfo.codeSize = description.spirv.size_bytes();
  moduleInfo.pCode = description.spirv.data();
  VkShaderModule module = VK_NULL_HANDLE;
  RINGLET_VK_CHECK(device_->vk().vkCreateShaderModule(device_->handle(), &moduleInfo, nullptr, &module),
                   attemptTo(description, device_->properties()));
  const OwnedShaderModule ownedModule(keeper, module);

  std::vector<VkSpecializationMapEntry> entries;
  for (std::size_t i = 0; i < description.constants.size(); ++i) {
    VkSpecializationMapEntry entry{};
    entry.constantID = description.constants[i].id;
    entry.offset = static_cast<std::uint32_t>(i * sizeof(SpecializationConstant) +
                                              offsetof(SpecializationConstant, value));
    entry.size = sizeof(SpecializationConstant::value);
    entries.push_back(entry);
  }
  VkSpecializationInfo specialization{};
  specialization.mapEntryCount = static_cast<std::uint32_t>(entries.size());
  specialization.pMapEntries = entries.data();
  specialization.dataSize = description.constants.size() * sizeof(SpecializationConstant);
  specialization.pData = description.constants.data();

  auto subgroupSize = zeroed<VkPipelineShaderStageRequiredSubgroupSizeCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO);
  subgroupSize.requiredSubgroupSize = subgroupSize_;

  auto info = zeroed<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module;
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specialization;
  if (hasFullSubgroups_) info.stage.flags = VK_PIPELINE_SHADER_STAGE_CREATE_REQUIRE_FULL_SUBGROUPS_BIT;
  if (asksForWidth) info.stage.pNext = &subgroupSize;
  info.layout = layout_.get();
  if (device_->properties().inspection == Inspection::statistics)
    info.flags |= VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
  VkPipeline pipeline = VK_NULL_HANDLE;
  const auto compiled = [&]() -> Status {
    RINGLET_VK_CHECK(device_->vk().vkCreateComputePipelines(device_->handle(), device_->pipelineCache(), 1,
                                                            &info, nullptr, &pipeline),
                     attemptTo(description, device_->properties()));
    return {};
  }();
  if (!compiled) {
    Error error = compiled.error();
    if (error.fault == Fault::other) error.fault = Fault::compile;
    return error;
  }
  pipeline_ = OwnedPipeline(keeper, pipeline);
  device_->nameObject(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(pipeline), description.name);
  return {};
}

Result<Bindings> Bindings::create(const Kernel& kernel, const BufferTable& buffers) {
  Device& device = kernel.device();
  const auto attempt = [&] { return fmt::format("bind the buffers of the kernel '{}'", kernel.name()); };

  Bindings self;
  self.bindings_ = kernel.bindings();

  // A pool for this one set; Vulkan wants no empty entries.
  std::vector<VkDescriptorPoolSize> sizes;
  for (BindingKind kind : {BindingKind::storage, BindingKind::uniform, BindingKind::texels}) {
    if (const std::uint32_t count = countOf(self.bindings_, kind))
      sizes.push_back({descriptorType(kind), count});
  }
  auto poolInfo = zeroed<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  poolInfo.maxSets = 1;
  poolInfo.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
  poolInfo.pPoolSizes = sizes.data();
  VkDescriptorPool pool = VK_NULL_HANDLE;
  RINGLET_VK_CHECK(device.vk().vkCreateDescriptorPool(device.handle(), &poolInfo, nullptr, &pool), attempt());
  self.pool_ = OwnedDescriptorPool(device.shared_from_this(), pool);

  const VkDescriptorSetLayout setLayout = kernel.setLayout();
  auto setInfo = zeroed<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  setInfo.descriptorPool = pool;
  setInfo.descriptorSetCount = 1;
  setInfo.pSetLayouts = &setLayout;
  RINGLET_VK_CHECK(device.vk().vkAllocateDescriptorSets(device.handle(), &setInfo, &self.set_), attempt());

  std::vector<VkDescriptorBufferInfo> infos(self.bindings_.size());
  std::vector<VkBufferView> views(self.bindings_.size());
  std::vector<VkWriteDescriptorSet> writes;
  for (std::size_t i = 0; i < self.bindings_.size(); ++i) {
    const auto& [number, kind] = self.bindings_[i];
    const auto found = buffers.find(number);
    RINGLET_ASSERT(found != buffers.end(), "a kernel needs a buffer for each of its bindings");
    const Buffer& buffer = found->second;
    const std::uint64_t limit = device.properties().maxUniformBufferRange;
    if (kind == BindingKind::uniform && buffer.capacity() > limit)
      return tooLargeUniform(buffer, limit, attempt());
    if (kind == BindingKind::texels) {
      auto view = viewOf(device, buffer);
      if (view.first != VK_SUCCESS) return vulkanError("vkCreateBufferView", view.first, attempt());
      views[i] = view.second.get();
      self.views_.push_back(std::move(view.second));
    }
    infos[i].buffer = buffer.handle();
    infos[i].range = buffer.capacity();
    auto write = zeroed<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    write.dstSet = self.set_;
    write.dstBinding = number;
    write.descriptorCount = 1;
    write.descriptorType = descriptorType(kind);
    write.pBufferInfo = &infos[i];
    write.pTexelBufferView = &views[i];
    writes.push_back(write);
  }
  device.vk().vkUpdateDescriptorSets(device.handle(), static_cast<std::uint32_t>(writes.size()),
                                     writes.data(), 0, nullptr);
  return self;
}

}  // namespace ringlet::gpu
