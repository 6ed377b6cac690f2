// Implements support/kernel_spy.h.
#include "tests/support/kernel_spy.h"

#include <cstring>
#include <utility>

#include "ringlet/base/assert.h"

namespace ringlet::test {
namespace {

struct Bound {
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;
};
struct Current {  // of a command buffer that is recorded
  SpiedCommand dispatch;
  SpiedCommands commands;
};

}  // namespace

struct KernelSpy::State {
  std::shared_ptr<gpu::Device> device;
  VolkDeviceTable real{};
  VolkDeviceTable& table() const { return const_cast<VolkDeviceTable&>(device->vk()); }
  gpu::Device::DebugCalls& debug() const {
    return const_cast<gpu::Device::DebugCalls&>(device->debugCalls());
  }

  std::map<VkShaderModule, std::vector<std::uint32_t>> modules;
  std::map<VkPipeline, std::vector<std::uint32_t>> pipelines;
  std::map<VkDeviceMemory, VkDeviceSize> sizes;
  std::map<VkDeviceMemory, std::byte*> mapped;
  std::map<VkBuffer, Bound> buffers;
  std::map<VkDescriptorSet, std::map<std::uint32_t, VkDescriptorBufferInfo>> sets;
  std::map<VkCommandBuffer, Current> recordings;
  SpiedCommands submitted;
  gpu::Device::DebugCalls realDebug;
  std::vector<std::string> labels;
};

namespace {
KernelSpy* theSpy = nullptr;
}

// In place of the table's functions; each calls the real one.
struct SpyCalls {
  static KernelSpy::State& spy() { return *theSpy->self_; }
  static Current& of(VkCommandBuffer commands) { return spy().recordings[commands]; }

  static VkResult createShaderModule(VkDevice device, const VkShaderModuleCreateInfo* info,
                                     const VkAllocationCallbacks* with, VkShaderModule* module) {
    const VkResult result = spy().real.vkCreateShaderModule(device, info, with, module);
    if (result == VK_SUCCESS) spy().modules[*module].assign(info->pCode, info->pCode + info->codeSize / 4);
    return result;
  }
  static VkResult createComputePipelines(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                         const VkComputePipelineCreateInfo* infos,
                                         const VkAllocationCallbacks* with, VkPipeline* pipelines) {
    const VkResult result = spy().real.vkCreateComputePipelines(device, cache, count, infos, with, pipelines);
    for (std::uint32_t k = 0; result == VK_SUCCESS && k < count; ++k)
      spy().pipelines[pipelines[k]] = spy().modules.at(infos[k].stage.module);
    return result;
  }
  static VkResult allocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                 const VkAllocationCallbacks* with, VkDeviceMemory* memory) {
    const VkResult result = spy().real.vkAllocateMemory(device, info, with, memory);
    if (result == VK_SUCCESS) spy().sizes[*memory] = info->allocationSize;
    return result;
  }
  // Emptied: what another buffer left there is no input.
  static VkResult mapMemory(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize bytes,
                            VkMemoryMapFlags flags, void** address) {
    const VkResult result = spy().real.vkMapMemory(device, memory, offset, bytes, flags, address);
    if (result != VK_SUCCESS) return result;
    std::byte* const first = spy().mapped[memory] = static_cast<std::byte*>(*address) - offset;
    std::memset(first, 0, spy().sizes.at(memory));
    return result;
  }
  static void freeMemory(VkDevice device, VkDeviceMemory memory, const VkAllocationCallbacks* with) {
    spy().mapped.erase(memory);
    spy().sizes.erase(memory);
    spy().real.vkFreeMemory(device, memory, with);
  }
  static VkResult bindBufferMemory(VkDevice device, VkBuffer buffer, VkDeviceMemory memory,
                                   VkDeviceSize offset) {
    spy().buffers[buffer] = {memory, offset};
    return spy().real.vkBindBufferMemory(device, buffer, memory, offset);
  }
  static void updateDescriptorSets(VkDevice device, std::uint32_t count, const VkWriteDescriptorSet* writes,
                                   std::uint32_t copyCount, const VkCopyDescriptorSet* copies) {
    for (std::uint32_t k = 0; k < count; ++k) spy().sets[writes[k].dstSet].clear();  // all at once
    for (std::uint32_t k = 0; k < count; ++k) {
      if (writes[k].pBufferInfo) spy().sets[writes[k].dstSet][writes[k].dstBinding] = *writes[k].pBufferInfo;
    }
    spy().real.vkUpdateDescriptorSets(device, count, writes, copyCount, copies);
  }

  static VkResult beginCommandBuffer(VkCommandBuffer commands, const VkCommandBufferBeginInfo* info) {
    of(commands) = {};
    return spy().real.vkBeginCommandBuffer(commands, info);
  }
  static void bindPipeline(VkCommandBuffer commands, VkPipelineBindPoint point, VkPipeline pipeline) {
    of(commands).dispatch.pipeline = pipeline;
    spy().real.vkCmdBindPipeline(commands, point, pipeline);
  }
  static void bindDescriptorSets(VkCommandBuffer commands, VkPipelineBindPoint point, VkPipelineLayout layout,
                                 std::uint32_t first, std::uint32_t count, const VkDescriptorSet* sets,
                                 std::uint32_t offsetCount, const std::uint32_t* offsets) {
    of(commands).dispatch.set = *sets;
    spy().real.vkCmdBindDescriptorSets(commands, point, layout, first, count, sets, offsetCount, offsets);
  }
  static void pushConstants(VkCommandBuffer commands, VkPipelineLayout layout, VkShaderStageFlags stages,
                            std::uint32_t offset, std::uint32_t count, const void* values) {
    const auto* bytes = static_cast<const std::byte*>(values);
    of(commands).dispatch.pushConstants.assign(bytes, bytes + count);
    spy().real.vkCmdPushConstants(commands, layout, stages, offset, count, values);
  }
  static void beginLabel(VkCommandBuffer commands, const VkDebugUtilsLabelEXT* label) {
    spy().labels.emplace_back(label->pLabelName);
    spy().realDebug.begin(commands, label);
  }
  static void endLabel(VkCommandBuffer commands) {
    spy().labels.emplace_back();
    spy().realDebug.end(commands);
  }
  static void dispatch(VkCommandBuffer commands, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    if (x > 0) of(commands).commands.push_back(of(commands).dispatch);
    spy().real.vkCmdDispatch(commands, x, y, z);
  }
  static void dispatchIndirect(VkCommandBuffer commands, VkBuffer counts, VkDeviceSize offset) {
    of(commands).commands.push_back(of(commands).dispatch);
    spy().real.vkCmdDispatchIndirect(commands, counts, offset);
  }
  static void copyBuffer(VkCommandBuffer commands, VkBuffer from, VkBuffer to, std::uint32_t count,
                         const VkBufferCopy* regions) {
    of(commands).commands.push_back({.kind = SpiedCommand::Kind::transfer});
    spy().real.vkCmdCopyBuffer(commands, from, to, count, regions);
  }
  static void fillBuffer(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset, VkDeviceSize bytes,
                         std::uint32_t value) {
    of(commands).commands.push_back({.kind = SpiedCommand::Kind::transfer});
    spy().real.vkCmdFillBuffer(commands, buffer, offset, bytes, value);
  }
  static void pipelineBarrier(VkCommandBuffer commands, VkPipelineStageFlags from, VkPipelineStageFlags to,
                              VkDependencyFlags flags, std::uint32_t count, const VkMemoryBarrier* barriers,
                              std::uint32_t bufferCount, const VkBufferMemoryBarrier* bufferBarriers,
                              std::uint32_t imageCount, const VkImageMemoryBarrier* imageBarriers) {
    for (std::uint32_t k = 0; k < count; ++k) {
      of(commands).commands.push_back({.kind = SpiedCommand::Kind::barrier,
                                       .from = from,
                                       .to = to,
                                       .written = barriers[k].srcAccessMask,
                                       .read = barriers[k].dstAccessMask});
    }
    spy().real.vkCmdPipelineBarrier(commands, from, to, flags, count, barriers, bufferCount, bufferBarriers,
                                    imageCount, imageBarriers);
  }
  static VkResult queueSubmit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos, VkFence fence) {
    for (std::uint32_t k = 0; k < count; ++k) {
      for (std::uint32_t b = 0; b < infos[k].commandBufferCount; ++b) {
        const SpiedCommands& commands = of(infos[k].pCommandBuffers[b]).commands;
        spy().submitted.insert(spy().submitted.end(), commands.begin(), commands.end());
        if (theSpy->onSubmit) theSpy->onSubmit(commands, fence != VK_NULL_HANDLE);
      }
    }
    return spy().real.vkQueueSubmit(queue, count, infos, fence);
  }
  static VkResult waitForFences(VkDevice device, std::uint32_t count, const VkFence* fences, VkBool32 all,
                                std::uint64_t timeout) {
    const VkResult result = spy().real.vkWaitForFences(device, count, fences, all, timeout);
    if (result != VK_SUCCESS) return result;
    const SpiedCommands done = std::exchange(spy().submitted, {});
    if (theSpy->onDone) theSpy->onDone(done);
    return result;
  }
};

KernelSpy::KernelSpy(gpu::Device& device) : self_(std::make_unique<State>()) {
  RINGLET_ASSERT(!theSpy, "two spies at a time");
  theSpy = this;
  self_->device = device.shared_from_this();
  VolkDeviceTable& table = self_->table();
  self_->real = table;
  table.vkCreateShaderModule = SpyCalls::createShaderModule;
  table.vkCreateComputePipelines = SpyCalls::createComputePipelines;
  table.vkAllocateMemory = SpyCalls::allocateMemory;
  table.vkMapMemory = SpyCalls::mapMemory;
  table.vkFreeMemory = SpyCalls::freeMemory;
  table.vkBindBufferMemory = SpyCalls::bindBufferMemory;
  table.vkUpdateDescriptorSets = SpyCalls::updateDescriptorSets;
  table.vkBeginCommandBuffer = SpyCalls::beginCommandBuffer;
  table.vkCmdBindPipeline = SpyCalls::bindPipeline;
  table.vkCmdBindDescriptorSets = SpyCalls::bindDescriptorSets;
  table.vkCmdPushConstants = SpyCalls::pushConstants;
  table.vkCmdDispatch = SpyCalls::dispatch;
  table.vkCmdDispatchIndirect = SpyCalls::dispatchIndirect;
  table.vkCmdCopyBuffer = SpyCalls::copyBuffer;
  table.vkCmdFillBuffer = SpyCalls::fillBuffer;
  table.vkCmdPipelineBarrier = SpyCalls::pipelineBarrier;
  table.vkQueueSubmit = SpyCalls::queueSubmit;
  table.vkWaitForFences = SpyCalls::waitForFences;
  self_->realDebug = device.debugCalls();
  if (self_->realDebug.begin)
    self_->debug() = {self_->realDebug.name, SpyCalls::beginLabel, SpyCalls::endLabel};
}

KernelSpy::~KernelSpy() {
  self_->table() = self_->real;
  self_->debug() = self_->realDebug;
  theSpy = nullptr;
}

const std::vector<std::string>& KernelSpy::labels() const { return self_->labels; }

const SpiedCommands& KernelSpy::recorded(VkCommandBuffer commands) const {
  return self_->recordings.at(commands).commands;
}

const std::vector<std::uint32_t>& KernelSpy::codeOf(VkPipeline pipeline) const {
  return self_->pipelines.at(pipeline);
}

std::map<std::uint32_t, std::span<const std::byte>> KernelSpy::buffersOf(VkDescriptorSet set) const {
  std::map<std::uint32_t, std::span<const std::byte>> found;
  for (const auto& [binding, info] : self_->sets.at(set)) {
    const Bound& bound = self_->buffers.at(info.buffer);
    const auto mapped = self_->mapped.find(bound.memory);
    if (mapped == self_->mapped.end() || info.range == VK_WHOLE_SIZE) continue;
    found[binding] = {mapped->second + bound.offset + info.offset, static_cast<std::size_t>(info.range)};
  }
  return found;
}

}  // namespace ringlet::test
