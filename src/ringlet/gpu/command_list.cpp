// Implements gpu/command_list.h.
#include "ringlet/gpu/command_list.h"

#include <algorithm>
#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/gpu/check.h"

namespace ringlet::gpu {
namespace {

constexpr VkPipelineStageFlags kWork = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
constexpr VkAccessFlags kWrites = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
constexpr VkAccessFlags kReads =
    VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_UNIFORM_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT;

void recordBarrier(const VolkDeviceTable& vk, VkCommandBuffer commands, VkAccessFlags readers,
                   VkPipelineStageFlags readingStages) {
  auto barrier = zeroed<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
  barrier.srcAccessMask = kWrites;
  barrier.dstAccessMask = readers;
  vk.vkCmdPipelineBarrier(commands, kWork, readingStages, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

// What each command becomes.
struct Writer {
  const VolkDeviceTable& vk;
  VkCommandBuffer commands;

  void operator()(const command::Dispatch& d) const {
    vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, d.kernel->pipeline());
    vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, d.kernel->layout(), 0, 1, &d.set, 0,
                               nullptr);
    if (!d.pushConstants.empty()) {
      vk.vkCmdPushConstants(commands, d.kernel->layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                            static_cast<std::uint32_t>(d.pushConstants.size()), d.pushConstants.data());
    }
    if (d.groupCounts != VK_NULL_HANDLE) {
      vk.vkCmdDispatchIndirect(commands, d.groupCounts, d.offset);
    } else {
      vk.vkCmdDispatch(commands, d.groupCount, 1, 1);
    }
  }
  void operator()(const command::Copy& c) const { vk.vkCmdCopyBuffer(commands, c.from, c.to, 1, &c.region); }
  void operator()(const command::Fill& f) const {
    vk.vkCmdFillBuffer(commands, f.buffer, f.offset, f.bytes, 0);
  }
  // One kind of barrier for everything: on compute work a narrower one gains nothing.
  void operator()(const command::Barrier&) const {
    recordBarrier(vk, commands, kReads | kWrites | VK_ACCESS_INDIRECT_COMMAND_READ_BIT,
                  kWork | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT);
  }
  void operator()(const command::Cut&) const {}
  void operator()(const command::BeginStage&) const {}
  void operator()(const command::EndStage&) const {}
};

// For tests; empty: not told.
struct Namer {
  std::string operator()(const command::Dispatch& d) const { return d.kernel->name(); }
  std::string operator()(const command::Copy&) const { return CommandList::kCopy; }
  std::string operator()(const command::Fill&) const { return CommandList::kFill; }
  std::string operator()(const command::Barrier&) const { return CommandList::kBarrier; }
  std::string operator()(const auto&) const { return {}; }
};

template <class T>
bool is(const Command& command) {
  return std::holds_alternative<T>(command);
}

}  // namespace

void CommandList::add(Command command) {
  RINGLET_ASSERT(isOpen_, "a command outside begin and submit");
  besides_.back().push_back(std::move(command));
}

void CommandList::clear() {
  besides_.assign(1, {});
  isStageOpen_ = false;
}

void CommandList::dispatch(const Kernel& kernel, const Bindings& bindings,
                           std::span<const std::byte> pushConstants, std::uint32_t groupCount) {
  RINGLET_ASSERT(groupCount <= kernel.device().properties().maxGroupCount,
                 "more workgroups than one dispatch may have");
  RINGLET_ASSERT(pushConstants.size() == kernel.pushConstantBytes(),
                 "push constants of a size the kernel does not have");
  RINGLET_ASSERT(bindings.bindings() == kernel.bindings(), "bindings made for a kernel that binds others");
  if (groupCount == 0) return;
  add(command::Dispatch{.kernel = &kernel,
                        .set = bindings.set(),
                        .pushConstants = {pushConstants.begin(), pushConstants.end()},
                        .groupCount = groupCount});
}

void CommandList::dispatchIndirect(const Kernel& kernel, const Bindings& bindings,
                                   std::span<const std::byte> pushConstants, const Buffer& groupCounts,
                                   std::uint64_t offset) {
  RINGLET_ASSERT(offset % 4 == 0 && offset + 3 * sizeof(std::uint32_t) <= groupCounts.bytes(),
                 "group counts outside their buffer");
  dispatch(kernel, bindings, pushConstants, 1);
  auto& added = std::get<command::Dispatch>(besides_.back().back());
  added.groupCounts = groupCounts.handle(), added.offset = offset;
}

void CommandList::dispatchNothing(const Kernel& kernel, const Bindings& bindings) {
  barrier();  // the validation layer does not count workgroups
  dispatch(kernel, bindings, std::vector<std::byte>(kernel.pushConstantBytes()), 1);
  std::get<command::Dispatch>(besides_.back().back()).groupCount = 0;
}

void CommandList::barrier() { add(command::Barrier{}); }

void CommandList::copyBuffer(const Buffer& from, const Buffer& to, std::uint64_t bytes,
                             std::uint64_t fromOffset, std::uint64_t toOffset) {
  RINGLET_ASSERT(fromOffset <= from.bytes() && bytes <= from.bytes() - fromOffset,
                 "a copy runs past its source's end");
  RINGLET_ASSERT(toOffset <= to.bytes() && bytes <= to.bytes() - toOffset,
                 "a copy runs past its target's end");
  if (bytes == 0) return;
  add(command::Copy{
      from.handle(), to.handle(), {.srcOffset = fromOffset, .dstOffset = toOffset, .size = bytes}});
}

void CommandList::copyFromHost(void* from, std::uint64_t fromOffset, const Buffer& to, std::uint64_t bytes,
                               std::uint64_t toOffset) {
  RINGLET_ASSERT(toOffset <= to.bytes() && bytes <= to.bytes() - toOffset,
                 "a copy runs past its target's end");
  if (bytes == 0) return;
  add(command::Copy{static_cast<VkBuffer>(from),
                    to.handle(),
                    {.srcOffset = fromOffset, .dstOffset = toOffset, .size = bytes}});
}

void CommandList::fillZero(const Buffer& buffer) { fillZero(buffer, buffer.capacity(), 0); }
void CommandList::fillZero(const Buffer& buffer, std::uint64_t bytes, std::uint64_t offset) {
  add(command::Fill{buffer.handle(), bytes, offset});
}

void CommandList::cut() {
  RINGLET_ASSERT(!isStageOpen_, "cut before endStage");
  add(command::Cut{});
}

void CommandList::beginStage(const std::string& name) {
  RINGLET_ASSERT(!isStageOpen_, "stages do not nest");
  add(command::BeginStage{name});
  isStageOpen_ = true;
}

void CommandList::endStage() {
  RINGLET_ASSERT(isStageOpen_, "endStage without beginStage");
  add(command::EndStage{});
  isStageOpen_ = false;
}

void CommandList::beside() {
  RINGLET_ASSERT(!isStageOpen_, "beside before endStage");
  besides_.emplace_back();
}

std::vector<const Command*> CommandList::inOrder() const {
  const bool isAlone = besides_.size() == 1;
  std::vector<const Command*> all;
  std::vector<std::size_t> next(besides_.size(), 0);
  for (bool goesOn = true; goesOn;) {
    const Command* barrier = nullptr;  // that the lists share
    for (std::size_t b = 0; b < besides_.size(); ++b) {
      const std::vector<Command>& list = besides_[b];
      for (; next[b] < list.size() && !is<command::Barrier>(list[next[b]]); ++next[b]) {
        const Command& command = list[next[b]];
        const bool isOfSubmissions =
            is<command::Cut>(command) || is<command::BeginStage>(command) || is<command::EndStage>(command);
        if (isAlone || !isOfSubmissions) all.push_back(&command);
      }
      if (next[b] < list.size()) barrier = &list[next[b]++];
    }
    goesOn = barrier != nullptr;
    if (goesOn) all.push_back(barrier);
  }
  return all;
}

std::vector<std::string> CommandList::recorded() const {
  std::vector<std::string> names;
  for (const Command* command : inOrder()) {
    if (std::string name = std::visit(Namer{}, *command); !name.empty()) names.push_back(std::move(name));
  }
  return names;
}

void CommandList::recordInto(const Device& device, VkCommandBuffer commands) const {
  recordCommand(device.vk(), commands, command::Barrier{});  // against what stands before
  for (const Command* command : inOrder()) {
    if (const auto* stage = std::get_if<command::BeginStage>(command))
      device.beginLabel(commands, stage->name);
    if (is<command::EndStage>(*command)) device.endLabel(commands);
    recordCommand(device.vk(), commands, *command);
  }
  recordHostBarrier(device.vk(), commands);
}

void recordCommand(const VolkDeviceTable& vk, VkCommandBuffer commands, const Command& command) {
  std::visit(Writer{vk, commands}, command);
}

void recordHostBarrier(const VolkDeviceTable& vk, VkCommandBuffer commands) {
  recordBarrier(vk, commands, VK_ACCESS_HOST_READ_BIT, VK_PIPELINE_STAGE_HOST_BIT);
}

}  // namespace ringlet::gpu
