// Kernels and recordings: constants, bindings, barriers and times, by a kernel whose results are plain
// formulas.
#include "tests/support/gpu_test.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/gpu/recorder.h"
#include "ringlet_shaders/scale_values_test.h"

namespace ringlet::test::recorder_test {
namespace {

using gpu::Bindings;
using gpu::Buffer;
using gpu::BufferKind;
using gpu::Kernel;
using gpu::Recorder;

// As scale_values.comp has them.
struct Push {
  std::uint32_t count;
  std::uint32_t factor;
};
constexpr std::uint32_t kGroupSize = 64;

gpu::KernelDescription describeKernel(std::uint32_t offset, bool wantsFullSubgroups = false) {
  return {.name = "scale_values",
          .spirv = k_scale_values_test,
          .pushConstantBytes = sizeof(Push),
          .constants = {{0, kGroupSize}, {1, offset}},
          .groupSize = kGroupSize,
          .wantsFullSubgroups = wantsFullSubgroups};
}

// A kernel and two buffers it goes back and forth between; the values begin as 0, 1, 2, ...
struct Bench {
  std::shared_ptr<const Kernel> kernel;
  std::array<Buffer, 2> values;
  Buffer shift;
  std::array<Bindings, 2> bindings;  // from buffer 0 to 1, and from 1 to 0
  Recorder recorder;
  std::uint32_t count;
  std::size_t current = 0;  // the buffer with the newest values

  static Result<Bench> create(gpu::Device& device, std::uint32_t count,
                              const gpu::KernelDescription& description) {
    const std::uint64_t bytes = count * sizeof(std::uint32_t);
    auto kernel = Kernel::create(device, description);
    if (!kernel) return kernel.error();
    auto even = Buffer::create(device, bytes, BufferKind::storage, "even");
    if (!even) return even.error();
    auto odd = Buffer::create(device, bytes, BufferKind::storage, "odd");
    if (!odd) return odd.error();
    auto shift = Buffer::create(device, 16, BufferKind::stream, "shift");
    if (!shift) return shift.error();
    auto there = Bindings::create(**kernel, {{0, *even}, {1, *odd}, {2, *shift}});
    if (!there) return there.error();
    auto back = Bindings::create(**kernel, {{0, *odd}, {1, *even}, {2, *shift}});
    if (!back) return back.error();
    auto recorder = Recorder::create(device, "bench");
    if (!recorder) return recorder.error();
    std::vector<std::uint32_t> numbers(count);
    for (std::uint32_t i = 0; i < count; ++i) numbers[i] = i;
    if (Status status = even->upload(std::as_bytes(std::span(numbers))); !status) return status.error();
    Bench self{std::move(*kernel),   {std::move(*even), std::move(*odd)},
               std::move(*shift),    {std::move(*there), std::move(*back)},
               std::move(*recorder), count};
    self.setShift(0);
    return self;
  }

  void setShift(std::uint32_t value) {
    const std::array<std::uint32_t, 4> record{value, 0, 0, 0};
    RINGLET_ASSERT(shift.upload(std::as_bytes(std::span(record))), "a mapped upload cannot fail");
  }
  void dispatch(std::uint32_t factor) {
    recorder.dispatch(*kernel, bindings[current], Push{count, factor}, (count + kGroupSize - 1) / kGroupSize);
    current = 1 - current;
  }
  std::vector<std::uint32_t> found() const {
    std::vector<std::uint32_t> numbers(count);
    const Status status = values[current].download(std::as_writable_bytes(std::span(numbers)));
    EXPECT_TRUE(status) << status.error().message;
    return numbers;
  }
};

#define RINGLET_EXPECT_OK(call)                                 \
  do {                                                          \
    const Status okStatus = (call);                             \
    EXPECT_TRUE(okStatus) << #call << okStatus.error().message; \
  } while (false)

using Recorders = GpuTest;

// Every constant reaches the kernel, and the last, partial workgroup does its part and no more.
TEST_F(Recorders, ConstantsReachTheKernel) {
  for (std::uint32_t count : {1u, 63u, 64u, 65u, 1000u}) {
    SCOPED_TRACE(count);
    auto bench = Bench::create(gpu(), count, describeKernel(5));
    ASSERT_TRUE(bench) << bench.error().message;
    bench->setShift(1000);
    RINGLET_EXPECT_OK(bench->recorder.begin());
    bench->dispatch(3);
    RINGLET_EXPECT_OK(bench->recorder.submitAndWait());
    const auto found = bench->found();
    for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(found[i], 3 * i + 1005) << i;
  }
}

TEST_F(Recorders, DispatchesFollowEachOtherAcrossBarriers) {
  auto bench = Bench::create(gpu(), 10000, describeKernel(1));
  ASSERT_TRUE(bench) << bench.error().message;
  RINGLET_EXPECT_OK(bench->recorder.begin());
  for (int i = 0; i < 10; ++i) {
    if (i > 0) bench->recorder.barrier();
    bench->dispatch(2);
  }
  RINGLET_EXPECT_OK(bench->recorder.submitAndWait());
  const auto found = bench->found();
  for (std::uint32_t i = 0; i < 10000; ++i)
    ASSERT_EQ(found[i], 1024 * i + 1023) << i;  // v -> 2 v + 1, ten times
}

// Lists that stand beside each other share barriers; the longest says how many there are. Stages and cuts
// would say something of all of them: they are left out.
TEST_F(Recorders, ListsBesideEachOtherShareBarriers) {
  auto bench = Bench::create(gpu(), 64, describeKernel(1));
  auto other = Bench::create(gpu(), 64, describeKernel(2));
  ASSERT_TRUE(bench && other);
  Recorder& recorder = bench->recorder;
  RINGLET_EXPECT_OK(recorder.begin());
  const auto add = [&](Bench& to) {
    recorder.dispatch(*to.kernel, to.bindings[to.current], Push{to.count, 2}, 1);
    to.current = 1 - to.current;
  };
  recorder.beginStage("first");
  add(*bench);
  recorder.barrier();
  add(*bench);
  recorder.endStage();
  recorder.cut();
  recorder.beside();
  add(*other);
  recorder.barrier();
  add(*other);
  recorder.barrier();
  add(*other);
  recorder.barrier();
  const std::string kernel = "scale_values", barrier = Recorder::kBarrier;
  EXPECT_EQ(recorder.recorded(),
            (std::vector<std::string>{kernel, kernel, barrier, kernel, kernel, barrier, kernel, barrier}));
  RINGLET_EXPECT_OK(recorder.submitAndWait());
  EXPECT_TRUE(recorder.stageMilliseconds().empty());
  const auto found = bench->found(), foundOther = other->found();
  for (std::uint32_t i = 0; i < 64; ++i) {
    EXPECT_EQ(found[i], 4 * i + 3);
    EXPECT_EQ(foundOther[i], 8 * i + 14);
  }
}

// A recording may be submitted again, with other uniforms, and be replaced by another.
TEST_F(Recorders, AreReusable) {
  auto bench = Bench::create(gpu(), 100, describeKernel(0));
  ASSERT_TRUE(bench) << bench.error().message;
  RINGLET_EXPECT_OK(bench->recorder.begin());
  bench->dispatch(1);
  bench->recorder.barrier();
  bench->dispatch(1);
  for (std::uint32_t shift : {1u, 10u, 100u}) {
    bench->setShift(shift);
    RINGLET_EXPECT_OK(bench->recorder.submit());
    RINGLET_EXPECT_OK(bench->recorder.wait());
  }
  bench->setShift(0);
  RINGLET_EXPECT_OK(bench->recorder.begin());
  bench->dispatch(2);
  RINGLET_EXPECT_OK(bench->recorder.submitAndWait());
  const auto found = bench->found();
  for (std::uint32_t i = 0; i < 100; ++i) ASSERT_EQ(found[i], 2 * (i + 222)) << i;
}

// A device is of the process that opened it: a child cannot use it.
TEST_F(Recorders, AChildOfForkIsRefused) {
  auto bench = Bench::create(gpu(), 64, describeKernel(0));
  ASSERT_TRUE(bench) << bench.error().message;
  RINGLET_EXPECT_OK(bench->recorder.begin());
  bench->dispatch(1);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const Status submitted = bench->recorder.submit();
    _exit(!submitted && submitted.error().message.find("after fork()") != std::string::npos ? 7 : 1);
  }
  int ended = 0;
  ASSERT_EQ(waitpid(child, &ended, 0), child);
  EXPECT_TRUE(WIFEXITED(ended) && WEXITSTATUS(ended) == 7) << ended;
  RINGLET_EXPECT_OK(bench->recorder.submitAndWait());
}

// A recording in parts is as many submissions, in order; each sees what the ones before wrote. It may be
// submitted again, and be replaced by one of fewer or more parts.
TEST_F(Recorders, PartsAreSubmittedOneByOne) {
  auto bench = Bench::create(gpu(), 1000, describeKernel(1));
  ASSERT_TRUE(bench) << bench.error().message;
  Recorder& recorder = bench->recorder;
  std::uint32_t expected = 0;  // of the value that began as 0: v -> 2 v + 1 a dispatch
  for (const std::size_t parts : {5u, 1u, 2u, 6u}) {
    SCOPED_TRACE(parts);
    RINGLET_EXPECT_OK(recorder.begin());
    for (std::size_t part = 0; part < parts; ++part) {
      if (part > 0) recorder.cut();
      recorder.beginStage("part");
      bench->dispatch(2);
      recorder.barrier();
      bench->dispatch(2);
      recorder.endStage();
    }
    for (int again = 0; again < 2; ++again) {  // an even number of dispatches ends where it began
      const std::uint64_t before = gpu().submissionCount();
      RINGLET_EXPECT_OK(recorder.submitAndWait());
      EXPECT_EQ(gpu().submissionCount(), before + parts);
      EXPECT_EQ(recorder.stageMilliseconds().size(), parts);
      for (std::size_t d = 0; d < 2 * parts; ++d) expected = 2 * expected + 1;
      EXPECT_EQ(bench->found()[0], expected);
    }
  }
}

TEST_F(Recorders, CopiesAndFillsAmongDispatches) {
  auto bench = Bench::create(gpu(), 100, describeKernel(7));
  auto copy = Buffer::create(gpu(), 400, BufferKind::stream, "copy");
  ASSERT_TRUE(bench && copy);
  Recorder& recorder = bench->recorder;
  RINGLET_EXPECT_OK(recorder.begin());
  bench->dispatch(2);
  recorder.barrier();
  recorder.copyBuffer(bench->values[1], *copy, 200, 4, 200);
  recorder.barrier();
  recorder.fillZero(bench->values[1]);
  recorder.barrier();
  bench->dispatch(2);
  RINGLET_EXPECT_OK(recorder.submitAndWait());
  std::vector<std::uint32_t> copied(50);
  RINGLET_EXPECT_OK(copy->download(std::as_writable_bytes(std::span(copied)), 200));
  for (std::uint32_t i = 0; i < 50; ++i) ASSERT_EQ(copied[i], 2 * (i + 1) + 7) << i;
  EXPECT_EQ(bench->found(), std::vector<std::uint32_t>(100, 7));
}

// The device reads how much to do when it gets there: here from what was copied just before.
TEST_F(Recorders, GroupCountsFoundOnTheDevice) {
  for (std::uint32_t groups : {0u, 1u, 2u}) {
    auto bench = Bench::create(gpu(), 100, describeKernel(7));
    auto wanted = Buffer::create(gpu(), 12, BufferKind::stream, "wanted");
    auto counts = Buffer::create(gpu(), 16, BufferKind::storage, "counts");
    ASSERT_TRUE(bench && wanted && counts);
    const std::array<std::uint32_t, 3> size{groups, 1, 1};
    RINGLET_EXPECT_OK(wanted->upload(std::as_bytes(std::span(size))));
    RINGLET_EXPECT_OK(bench->values[1].fillZero());
    RINGLET_EXPECT_OK(bench->recorder.begin());
    bench->recorder.copyBuffer(*wanted, *counts, 12, 0, 4);
    bench->recorder.barrier();
    bench->recorder.dispatchIndirect(*bench->kernel, bench->bindings[0], Push{bench->count, 2}, *counts, 4);
    RINGLET_EXPECT_OK(bench->recorder.submitAndWait());
    bench->current = 1;
    const auto found = bench->found();
    for (std::uint32_t i = 0; i < 100; ++i) ASSERT_EQ(found[i], i < groups * kGroupSize ? 2 * i + 7 : 0) << i;
  }
}

TEST_F(Recorders, FullSubgroupsWherePromised) {
  auto bench = Bench::create(gpu(), 1000, describeKernel(2, true));
  ASSERT_TRUE(bench) << bench.error().message;
  const auto& p = gpu().properties();
  EXPECT_EQ(bench->kernel->hasFullSubgroups(), p.hasFullSubgroups && kGroupSize % p.subgroupSize == 0);
  RINGLET_EXPECT_OK(bench->recorder.begin());
  bench->dispatch(1);
  RINGLET_EXPECT_OK(bench->recorder.submitAndWait());
  EXPECT_EQ(bench->found()[999], 1001u);
}

// The same on a device as poor as may be: no mapping, no timestamps, no choice of subgroups.
TEST_F(Recorders, WorkOnAPoorDevice) {
  auto device =
      gpu::Device::open("", {.alwaysStage = true, .withoutTimestamps = true, .withoutFullSubgroups = true});
  ASSERT_TRUE(device) << device.error().message;
  {
    auto bench = Bench::create(**device, 1000, describeKernel(1, true));
    ASSERT_TRUE(bench) << bench.error().message;
    EXPECT_FALSE(bench->kernel->hasFullSubgroups());
    Recorder& recorder = bench->recorder;
    RINGLET_EXPECT_OK(recorder.begin());
    for (const char* stage : {"first", "second"}) {
      recorder.beginStage(stage);
      bench->dispatch(2);
      recorder.barrier();
      recorder.endStage();
    }
    RINGLET_EXPECT_OK(recorder.submitAndWait());
    const auto found = bench->found();
    for (std::uint32_t i = 0; i < 1000; ++i) ASSERT_EQ(found[i], 4 * i + 3) << i;
    const double half = recorder.submissionMilliseconds() / 2;
    EXPECT_GT(half, 0);
    const std::vector<std::pair<std::string, double>> expected{{"first", half}, {"second", half}};
    EXPECT_EQ(recorder.stageMilliseconds(), expected);
  }
  expectNoMessages(*(*device)->validationLog());
}

// More stages than one pool of timestamps holds.
TEST_F(Recorders, StagesAreTimed) {
  constexpr std::size_t kStages = 150;
  auto bench = Bench::create(gpu(), 5000, describeKernel(0));
  ASSERT_TRUE(bench) << bench.error().message;
  Recorder& recorder = bench->recorder;
  RINGLET_EXPECT_OK(recorder.begin());
  for (std::size_t i = 0; i < kStages; ++i) {
    recorder.beginStage("stage " + std::to_string(i));
    bench->dispatch(1);
    recorder.barrier();
    recorder.endStage();
  }
  for (int submission = 0; submission < 2; ++submission) {
    RINGLET_EXPECT_OK(recorder.submitAndWait());
    ASSERT_EQ(recorder.stageMilliseconds().size(), kStages);
    double sum = 0;
    for (std::size_t i = 0; i < kStages; ++i) {
      const auto& [name, milliseconds] = recorder.stageMilliseconds()[i];
      EXPECT_EQ(name, "stage " + std::to_string(i));
      EXPECT_GE(milliseconds, 0) << name;
      sum += milliseconds;
    }
    // Stages do not overlap: together they take no longer than the submission, but for the two clocks'
    // difference.
    EXPECT_GT(sum, 0);
    EXPECT_LT(sum, 1.1 * recorder.submissionMilliseconds());
  }
}

TEST_F(Recorders, NothingToDoIsFine) {
  auto bench = Bench::create(gpu(), 0, describeKernel(0));
  ASSERT_TRUE(bench) << bench.error().message;
  RINGLET_EXPECT_OK(bench->recorder.begin());
  bench->dispatch(1);
  RINGLET_EXPECT_OK(bench->recorder.submitAndWait());
  EXPECT_TRUE(bench->recorder.stageMilliseconds().empty());
}

TEST_F(Recorders, WorkUnderWayIsAwaitedAtTheEnd) {
  auto bench = Bench::create(gpu(), 100000, describeKernel(0));
  ASSERT_TRUE(bench) << bench.error().message;
  auto other = Recorder::create(gpu(), "left alone");
  ASSERT_TRUE(other) << other.error().message;
  RINGLET_EXPECT_OK(other->begin());
  other->dispatch(*bench->kernel, bench->bindings[0], Push{bench->count, 2}, 1000);
  RINGLET_EXPECT_OK(other->submit());
}  // `other` goes first

TEST_F(Recorders, KernelsBeyondTheDeviceAreRefusedWithNumbers) {
  const auto& p = gpu().properties();
  {
    auto description = describeKernel(0);
    description.groupSize = p.maxGroupInvocations + 1;
    auto kernel = Kernel::create(gpu(), description);
    ASSERT_FALSE(kernel);
    expectParts(kernel.error().message, {"'scale_values'", std::to_string(p.maxGroupInvocations + 1),
                                         std::to_string(p.maxGroupInvocations)});
  }
  {
    auto description = describeKernel(0);
    description.pushConstantBytes = p.maxPushConstantBytes + 4;
    auto kernel = Kernel::create(gpu(), description);
    ASSERT_FALSE(kernel);
    expectParts(kernel.error().message, {std::to_string(p.maxPushConstantBytes + 4)});
  }
  auto kernel = Kernel::create(gpu(), describeKernel(0));
  ASSERT_TRUE(kernel) << kernel.error().message;
  auto values = Buffer::create(gpu(), 16, BufferKind::storage, "values");
  auto shift = Buffer::create(gpu(), p.maxUniformBufferRange + 1, BufferKind::stream, "wide");
  ASSERT_TRUE(values);
  if (!shift) return;  // a device whose uniforms may be as large as its buffers
  auto bindings = Bindings::create(**kernel, {{0, *values}, {1, *values}, {2, *shift}});
  ASSERT_FALSE(bindings);
  expectParts(bindings.error().message, {"'wide'", std::to_string(p.maxUniformBufferRange)});
}

TEST_F(Recorders, MisuseIsTheCallersFault) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // the driver has threads
  auto bench = Bench::create(gpu(), 16, describeKernel(0));
  ASSERT_TRUE(bench) << bench.error().message;
  Recorder& recorder = bench->recorder;
  const std::uint32_t tooMany = gpu().properties().maxGroupCount;
  EXPECT_DEATH(bench->dispatch(1), "outside begin and submit");
  EXPECT_DEATH((void)recorder.wait(), "wait without submit");
  RINGLET_EXPECT_OK(recorder.begin());
  EXPECT_DEATH(recorder.dispatch(*bench->kernel, bench->bindings[0], std::uint32_t{1}, 1),
               "push constants of a size");
  if (tooMany != ~0u) {
    EXPECT_DEATH(recorder.dispatch(*bench->kernel, bench->bindings[0], Push{1, 1}, tooMany + 1),
                 "more workgroups");
  }
  EXPECT_DEATH(recorder.endStage(), "endStage without beginStage");
  recorder.beginStage("open");
  EXPECT_DEATH(recorder.cut(), "cut before endStage");
  recorder.endStage();
  EXPECT_DEATH((void)Bindings::create(*bench->kernel, {{2, bench->shift}}),
               "a buffer for each of its bindings");
}

std::string joined(const std::vector<std::string>& messages) {
  std::string text;
  for (const std::string& message : messages) text += message + "\n";
  return text;
}

// That the tests above saw no message means something: a barrier left out is found. Reading what was just
// written, and writing what is still being read.
TEST_F(Recorders, ValidationSeesAMissingBarrier) {
  for (const bool isReadAfterWrite : {true, false}) {
    auto device = gpu::Device::open();
    ASSERT_TRUE(device) << device.error().message;
    {
      auto bench = Bench::create(**device, 100, describeKernel(0));
      auto other = Buffer::create(**device, 400, BufferKind::storage, "other");
      ASSERT_TRUE(bench && other);
      auto intoSource =
          Bindings::create(*bench->kernel, {{0, *other}, {1, bench->values[0]}, {2, bench->shift}});
      ASSERT_TRUE(intoSource) << intoSource.error().message;
      RINGLET_EXPECT_OK(other->fillZero());
      RINGLET_EXPECT_OK(bench->recorder.begin());
      bench->dispatch(1);
      bench->recorder.dispatch(*bench->kernel, isReadAfterWrite ? bench->bindings[1] : *intoSource,
                               Push{100, 1}, 2);
      RINGLET_EXPECT_OK(bench->recorder.submitAndWait());
    }
    const char* hazard = isReadAfterWrite ? "SYNC-HAZARD-READ-AFTER-WRITE" : "SYNC-HAZARD-WRITE-AFTER-READ";
    expectParts(joined((*device)->validationMessages()), {hazard});
  }
}

// A leak is a message too, after the device has closed.
TEST_F(Recorders, ValidationOutlivesTheDevice) {
  auto device = gpu::Device::open();
  ASSERT_TRUE(device) << device.error().message;
  const auto log = (*device)->validationLog();
  auto info = gpu::zeroed<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
  VkFence leaked = VK_NULL_HANDLE;
  ASSERT_EQ((*device)->vk().vkCreateFence((*device)->handle(), &info, nullptr, &leaked), VK_SUCCESS);
  device->reset();
  expectParts(joined(log->messages()), {"VkFence"});
}

}  // namespace
}  // namespace ringlet::test::recorder_test
