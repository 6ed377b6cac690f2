// Barriers between the host and the device, as they reach Vulkan. The validation layer does not see what the
// host reads of mapped memory, and on a processor all is seen without them. Mirrors gpu/command_list.h and
// gpu/recorder.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "ringlet/gpu/recorder.h"
#include "ringlet/solver/plan/submission_pace.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/kernel_spy.h"
#include "tests/support/parity.h"

namespace ringlet::test::host_recording_test {
namespace {

constexpr VkPipelineStageFlags kWork = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
constexpr VkAccessFlags kWritten = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;

bool has(VkFlags flags, VkFlags wanted) { return (flags & wanted) == wanted; }

// All that was done is over, and seen by kernels, copies and the counts of indirect dispatches.
void expectBarrierBetweenWork(const SpiedCommand& command) {
  ASSERT_EQ(command.kind, SpiedCommand::Kind::barrier);
  EXPECT_TRUE(has(command.from, kWork));
  EXPECT_TRUE(has(command.written, kWritten));
  EXPECT_TRUE(has(command.to, kWork | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT));
  EXPECT_TRUE(has(command.read, kWritten | VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_UNIFORM_READ_BIT |
                                    VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT));
}

// All that was done is over, and seen by the host.
void expectBarrierToHost(const SpiedCommand& command) {
  ASSERT_EQ(command.kind, SpiedCommand::Kind::barrier);
  EXPECT_TRUE(has(command.from, kWork));
  EXPECT_TRUE(has(command.written, kWritten));
  EXPECT_TRUE(has(command.to, VK_PIPELINE_STAGE_HOST_BIT));
  EXPECT_TRUE(has(command.read, VK_ACCESS_HOST_READ_BIT));
}

// It begins with a barrier against what was submitted before, and ends with one to the host, if that waits
// for it.
void expectBarriers(const SpiedCommands& commands, bool isWaitedFor) {
  ASSERT_GE(commands.size(), 2u);
  expectBarrierBetweenWork(commands.front());
  for (std::size_t k = 0; k + 1 < commands.size(); ++k)
    if (commands[k].kind == SpiedCommand::Kind::barrier) expectBarrierBetweenWork(commands[k]);
  if (isWaitedFor) expectBarrierToHost(commands.back());
}

// What a capture tool shows: spans with names, one after the other, which all end.
void expectLabels(const std::vector<std::string>& labels, const std::string& one) {
  EXPECT_TRUE(std::ranges::count(labels, one)) << one;
  ASSERT_EQ(labels.size() % 2, 0u);
  for (std::size_t k = 0; k < labels.size(); k += 2) {
    EXPECT_FALSE(labels[k].empty()) << k;
    EXPECT_TRUE(labels[k + 1].empty()) << labels[k] << " does not end before " << labels[k + 1];
  }
}

class HostRecording : public GpuTest {
 protected:
  // Frames, reads and writes of some hair on a device of its own; each submission is looked at.
  void run(const gpu::DeviceOptions& options, const Settings& settings, const KernelChoice& kernel = {}) {
    const auto opened = gpu::Device::open("", options);
    ASSERT_TRUE(opened) << opened.error().message;
    KernelSpy spy(**opened);
    int submissions = 0;
    spy.onSubmit = [&](const SpiedCommands& commands, bool isLast) {
      SCOPED_TRACE("submission " + std::to_string(++submissions));
      expectBarriers(commands, isLast);
    };
    {
      const Groom groom = randomGroom({8, 16, 20, 8}, 3);
      auto hair = Simulation::create(ComputeDevice::over(*opened), groom, {}, settings, {}, kernel);
      ASSERT_TRUE(hair) << hair.error().message;
      ASSERT_TRUE(hair->stepFrame(HeadPose{}));
      const auto state = hair->state();
      ASSERT_TRUE(state);
      ASSERT_TRUE(hair->setState(*state));
      ASSERT_TRUE(hair->cut(std::vector<StrandCut>{{1, 9}}));
      HeadPose moved;
      moved.position = {0.01, 0, 0};
      ASSERT_TRUE(hair->stepFrame(moved));
      EXPECT_TRUE(hair->report());
    }
    EXPECT_GE(submissions, 2);
    expectLabels(spy.labels(), SubmissionPace::kStrandStage);
    expectNoMessages(*(*opened)->validationLog());
  }
};

TEST_F(HostRecording, EverySubmissionHasItsBarriers) {
  Settings settings, contacts, volume;
  contacts.contacts.on = true;
  contacts.contacts.method = ContactMethod::explicitPairs;
  volume.contacts.on = true;
  volume.contacts.method = ContactMethod::volume;
  for (const Settings& each : {settings, contacts, volume}) run({}, each);
  run({.alwaysStage = true}, settings);
  run({}, settings, {.longestSubmissionSeconds = 1e-9});  // many submissions, of a step each
}

// A host's commands have them too, whatever stands before and behind.
TEST_F(HostRecording, CommandsOfAHostHaveTheirBarriers) {
  const auto opened = gpu::Device::open();
  ASSERT_TRUE(opened) << opened.error().message;
  gpu::Device& own = **opened;
  KernelSpy spy(own);
  auto poolInfo = VkCommandPoolCreateInfo{};
  poolInfo.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  poolInfo.queueFamilyIndex = own.queueFamily();
  VkCommandPool pool = VK_NULL_HANDLE;
  ASSERT_EQ(own.vk().vkCreateCommandPool(own.handle(), &poolInfo, nullptr, &pool), VK_SUCCESS);
  auto info = VkCommandBufferAllocateInfo{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  info.commandPool = pool;
  info.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  ASSERT_EQ(own.vk().vkAllocateCommandBuffers(own.handle(), &info, &commands), VK_SUCCESS);
  auto begin = VkCommandBufferBeginInfo{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  ASSERT_EQ(own.vk().vkBeginCommandBuffer(commands, &begin), VK_SUCCESS);
  {
    auto from = gpu::Buffer::create(own, 64, gpu::BufferKind::storage, "from"),
         to = gpu::Buffer::create(own, 64, gpu::BufferKind::stream, "to");
    ASSERT_TRUE(from && to);
    gpu::CommandList list;
    list.beginStage("fill and copy");
    list.fillZero(*from);
    list.barrier();
    list.copyBuffer(*from, *to, 64);
    list.endStage();
    list.recordInto(own, commands);
    EXPECT_EQ(own.vk().vkEndCommandBuffer(commands), VK_SUCCESS);
    EXPECT_EQ(spy.recorded(commands).size(), 5u);
    expectBarriers(spy.recorded(commands), true);
    EXPECT_EQ(spy.labels(), (std::vector<std::string>{"fill and copy", ""}));
    own.vk().vkDestroyCommandPool(own.handle(), pool, nullptr);
  }
  expectNoMessages(*own.validationLog());
}

}  // namespace
}  // namespace ringlet::test::host_recording_test
