// Implements gpu/recorder.h.
#include "ringlet/gpu/recorder.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <variant>

#include <fmt/format.h>

#include "ringlet/base/assert.h"
#include "ringlet/gpu/check.h"

namespace ringlet::gpu {
namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr std::uint32_t kStagesPerPool = 64;                   // two timestamps each
constexpr std::uint32_t kQueriesPerPool = 2 * kStagesPerPool;  // pools are added as stages come

}  // namespace

struct Recorder::State {
  enum class Phase { empty, recording, recorded, submitted };

  std::shared_ptr<Device> device;
  std::string name;
  OwnedCommandPool pool;
  std::vector<VkCommandBuffer> parts;         // go with the pool; those of the recording come first
  std::size_t partCount = 0;                  // of the recording
  VkCommandBuffer commands = VK_NULL_HANDLE;  // its last
  OwnedFence fence;
  std::vector<OwnedQueryPool> timestamps;
  Phase phase = Phase::empty;
  std::vector<std::string> stages;
  Clock::time_point submitted;
  double submissionMilliseconds = 0,
         ownMilliseconds = 0;  // from submit; from the wait before, if that is later
  double submitMilliseconds = 0, fenceMilliseconds = 0;
  std::vector<std::pair<std::string, double>> stageMilliseconds;
  std::vector<double> stageStarts;

  ~State() {
    // Nothing may be destroyed under the device's hands; a lost device answers at once. Where the fence tells
    // nothing, work may still go on.
    if (!device->isOfThisProcess()) return;
    if (phase == Phase::submitted && !waitForFence()) (void)vk().vkDeviceWaitIdle(device->handle());
  }

  const VolkDeviceTable& vk() const { return device->vk(); }
  std::string attempt(const char* what) const {
    return fmt::format("{} '{}' on {}", what, name, device->properties().name);
  }

  // The pool of stage `index`, made and reset when its first stage is recorded.
  Status preparePool(std::size_t index) {
    if (index % kStagesPerPool != 0) return {};
    if (index / kStagesPerPool == timestamps.size()) {
      auto info = zeroed<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
      info.queryType = VK_QUERY_TYPE_TIMESTAMP;
      info.queryCount = kQueriesPerPool;
      VkQueryPool queries = VK_NULL_HANDLE;
      RINGLET_VK_CHECK(vk().vkCreateQueryPool(device->handle(), &info, nullptr, &queries),
                       attempt("time the stages of"));
      timestamps.emplace_back(device, queries);
    }
    vk().vkCmdResetQueryPool(commands, timestamps[index / kStagesPerPool].get(), 0, kQueriesPerPool);
    return {};
  }

  // At the bottom of the pipe both for begin and end: written once everything before is done, so stages that
  // follow each other do not overlap and add up to the whole.
  void writeTimestamp(std::size_t stage, std::uint32_t which) {
    vk().vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT,
                             timestamps[stage / kStagesPerPool].get(),
                             static_cast<std::uint32_t>(stage % kStagesPerPool) * 2 + which);
  }

  Status beginStage(const std::string& stage) {
    stages.push_back(stage);
    device->beginLabel(commands, stage);
    if (!device->properties().hasTimestamps) return {};
    if (Status status = preparePool(stages.size() - 1); !status) return status;
    writeTimestamp(stages.size() - 1, 0);
    return {};
  }
  void endStage() {
    if (device->properties().hasTimestamps) writeTimestamp(stages.size() - 1, 1);
    device->endLabel(commands);
  }

  Status waitForFence() {
    const VkFence handle = fence.get();
    VkResult result = VK_TIMEOUT;
    while (result == VK_TIMEOUT) {
      result = vk().vkWaitForFences(device->handle(), 1, &handle, VK_TRUE,
                                    std::numeric_limits<std::uint64_t>::max());
    }
    if (result != VK_SUCCESS) return vulkanError("vkWaitForFences", result, attempt("finish"));
    return {};
  }

  Status readStages() {
    stageMilliseconds.clear();
    stageStarts.clear();
    const DeviceProperties& properties = device->properties();
    if (!properties.hasTimestamps) {
      for (const std::string& stage : stages) {
        const double each = ownMilliseconds / static_cast<double>(stages.size());
        stageStarts.push_back(each * static_cast<double>(stageMilliseconds.size()));
        stageMilliseconds.emplace_back(stage, each);
      }
      return {};
    }
    // A timestamp wraps around at its valid bits.
    const std::uint64_t mask =
        properties.timestampBits >= 64 ? ~0ull : (1ull << properties.timestampBits) - 1;
    std::vector<std::uint64_t> ticks(kQueriesPerPool);
    for (std::size_t first = 0; first < stages.size(); first += kStagesPerPool) {
      const auto count =
          static_cast<std::uint32_t>(std::min<std::size_t>(kStagesPerPool, stages.size() - first));
      RINGLET_VK_CHECK(
          vk().vkGetQueryPoolResults(device->handle(), timestamps[first / kStagesPerPool].get(), 0, 2 * count,
                                     2 * count * sizeof(std::uint64_t), ticks.data(), sizeof(std::uint64_t),
                                     VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          attempt("time the stages of"));
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint64_t elapsed = (ticks[2 * i + 1] - ticks[2 * i]) & mask;
        stageMilliseconds.emplace_back(stages[first + i],
                                       static_cast<double>(elapsed) * properties.timestampPeriod * 1e-6);
        stageStarts.push_back(static_cast<double>(ticks[2 * i] & mask) * properties.timestampPeriod * 1e-6);
      }
    }
    return {};
  }
};

Recorder::Recorder(std::unique_ptr<State> state) : self_(std::move(state)) {}
Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;
Recorder::~Recorder() = default;

Result<Recorder> Recorder::create(Device& device, const std::string& name) {
  auto self = std::make_unique<State>();
  self->device = device.shared_from_this();
  self->name = name;

  auto poolInfo = zeroed<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  poolInfo.queueFamilyIndex = device.queueFamily();
  VkCommandPool pool = VK_NULL_HANDLE;
  RINGLET_VK_CHECK(device.vk().vkCreateCommandPool(device.handle(), &poolInfo, nullptr, &pool),
                   self->attempt("record"));
  self->pool = OwnedCommandPool(self->device, pool);

  auto fenceInfo = zeroed<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
  VkFence fence = VK_NULL_HANDLE;
  RINGLET_VK_CHECK(device.vk().vkCreateFence(device.handle(), &fenceInfo, nullptr, &fence),
                   self->attempt("record"));
  self->fence = OwnedFence(self->device, fence);
  Recorder recorder(std::move(self));
  recorder.isOpen_ = false;
  return recorder;
}

// Command buffers are made as parts are recorded, and kept.
Status Recorder::beginPart() {
  if (self_->partCount == self_->parts.size()) {
    auto info = zeroed<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    info.commandPool = self_->pool.get();
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    VkCommandBuffer part = VK_NULL_HANDLE;
    RINGLET_VK_CHECK(self_->vk().vkAllocateCommandBuffers(self_->device->handle(), &info, &part),
                     self_->attempt("record"));
    self_->device->nameObject(VK_OBJECT_TYPE_COMMAND_BUFFER, reinterpret_cast<std::uint64_t>(part),
                              self_->name);
    self_->parts.push_back(part);
  }
  self_->commands = self_->parts[self_->partCount];
  auto info = zeroed<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  RINGLET_VK_CHECK(self_->vk().vkBeginCommandBuffer(self_->commands, &info), self_->attempt("record"));
  ++self_->partCount;
  recordCommand(self_->vk(), self_->commands, command::Barrier{});  // against earlier submissions
  return {};
}

Status Recorder::endPart() {
  RINGLET_VK_CHECK(self_->vk().vkEndCommandBuffer(self_->commands), self_->attempt("record"));
  return {};
}

Status Recorder::begin() {
  RINGLET_ASSERT(self_->phase != State::Phase::submitted, "begin before wait");
  isOpen_ = false;
  self_->phase = State::Phase::empty;
  RINGLET_VK_CHECK(self_->vk().vkResetCommandPool(self_->device->handle(), self_->pool.get(), 0),
                   self_->attempt("record"));
  clear();
  isOpen_ = true;
  self_->phase = State::Phase::recording;
  return {};
}

// The list into command buffers, a part for each cut.
Status Recorder::write() {
  self_->stages.clear();
  self_->partCount = 0;
  if (Status status = beginPart(); !status) return status;
  for (const Command* command : inOrder()) {
    if (std::holds_alternative<command::Cut>(*command)) {
      if (Status status = endPart(); !status) return status;
      if (Status status = beginPart(); !status) return status;
    } else if (const auto* stage = std::get_if<command::BeginStage>(command)) {
      if (Status status = self_->beginStage(stage->name); !status) return status;
    } else if (std::holds_alternative<command::EndStage>(*command)) {
      self_->endStage();
    } else {
      recordCommand(self_->vk(), self_->commands, *command);
    }
  }
  recordHostBarrier(self_->vk(), self_->commands);  // for what is mapped
  return endPart();
}

Status Recorder::submit() {
  RINGLET_ASSERT(self_->phase == State::Phase::recording || self_->phase == State::Phase::recorded,
                 "submit without a recording, or before wait");
  if (Status status = self_->device->checkProcess(); !status) return status;
  const Clock::time_point begin = Clock::now();
  if (self_->phase == State::Phase::recording) {
    RINGLET_ASSERT(!isStageOpen(), "submit before endStage");
    isOpen_ = false;
    if (Status status = write(); !status) return status;
    self_->phase = State::Phase::recorded;
  }
  const VkFence fence = self_->fence.get();
  RINGLET_VK_CHECK(self_->vk().vkResetFences(self_->device->handle(), 1, &fence), self_->attempt("submit"));
  self_->submitted = Clock::now();
  const VkResult submitted = self_->device->submit(std::span(self_->parts).first(self_->partCount), fence);
  if (submitted != VK_SUCCESS) return vulkanError("vkQueueSubmit", submitted, self_->attempt("submit"));
  self_->phase = State::Phase::submitted;
  self_->submitMilliseconds = Milliseconds(Clock::now() - begin).count();
  return {};
}

Status Recorder::wait() {
  RINGLET_ASSERT(self_->phase == State::Phase::submitted, "wait without submit");
  if (Status status = self_->device->checkProcess(); !status) return status;
  const Clock::time_point begin = Clock::now();
  if (Status status = self_->waitForFence(); !status) return status;  // its end is still to come
  self_->phase = State::Phase::recorded;
  const Clock::time_point now = Clock::now(), before = self_->device->noteWait(now);
  self_->fenceMilliseconds = Milliseconds(now - begin).count();
  self_->submissionMilliseconds = Milliseconds(now - self_->submitted).count();
  self_->ownMilliseconds = Milliseconds(now - std::max(self_->submitted, before)).count();
  return self_->readStages();
}

Status Recorder::submitAndWait() {
  if (Status status = submit(); !status) return status;
  return wait();
}

const std::vector<std::pair<std::string, double>>& Recorder::stageMilliseconds() const {
  return self_->stageMilliseconds;
}
const std::vector<double>& Recorder::stageStarts() const { return self_->stageStarts; }
double Recorder::submissionMilliseconds() const { return self_->submissionMilliseconds; }
double Recorder::submitMilliseconds() const { return self_->submitMilliseconds; }
double Recorder::fenceMilliseconds() const { return self_->fenceMilliseconds; }

}  // namespace ringlet::gpu
