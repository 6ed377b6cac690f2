// Which widths a user can ask for, and which of those that were timed is taken.
#include "ringlet/solver/plan/subgroup_choice.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "ringlet/groom/generate.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"
#include "ringlet/solver/strands/strand_kernels.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::subgroup_choice_test {
namespace {

using Widths = std::vector<std::uint32_t>;

DeviceLimits limitsOf(std::uint32_t chosen, std::uint32_t smallest, std::uint32_t largest) {
  DeviceLimits limits;
  limits.subgroupSize = chosen, limits.minSubgroupSize = smallest, limits.maxSubgroupSize = largest;
  return limits;
}

TEST(SubgroupChoice, OffersTheRangeAndRefusesTheRest) {
  EXPECT_EQ(subgroupSizes(limitsOf(32, 32, 64)), (Widths{32, 64}));
  EXPECT_EQ(subgroupSizes(limitsOf(8, 8, 32)), (Widths{8, 16, 32}));
  EXPECT_EQ(subgroupSizes(limitsOf(16, 8, 32)), (Widths{16, 8, 32}));
  EXPECT_EQ(subgroupSizes(limitsOf(8, 8, 8)), (Widths{8}));
  EXPECT_EQ(subgroupSizes(limitsOf(4, 0, 0)), (Widths{4}));

  const DeviceLimits intel = limitsOf(8, 8, 32);
  for (int width = -1; width <= 128; ++width) {
    const auto chosen = withSubgroupSize(intel, width);
    const bool isPossible = width == 0 || width == 8 || width == 16 || width == 32;
    ASSERT_EQ(static_cast<bool>(chosen), isPossible) << width;
    if (isPossible) {
      EXPECT_EQ(chosen->subgroupSize, width == 0 ? 8u : static_cast<std::uint32_t>(width));
    } else {
      expectParts(chosen.error().message, {std::to_string(width), "8, 16 or 32"});
    }
  }
  expectParts(withSubgroupSize(limitsOf(4, 0, 0), 8).error().message, {"this device can have 4,"});
}

TEST(SubgroupChoice, OthersAreToldWhatThereIsInOrder) {
  const auto refused = withSubgroupSize(limitsOf(32, 8, 64), 3);
  ASSERT_FALSE(refused);
  expectParts(refused.error().message,
              {"a subgroup of 3 was asked for; this device can have 8, 16, 32 or 64, 0 chooses"});
}

TEST(SubgroupChoice, TheFastestWidthIsThatOfTheBestShapes) {
  EXPECT_EQ(fastestSubgroupSize({}), 0u);
  const std::vector<WidthTime> times{{16, 32, 5}, {16, 32, 3}, {64, 32, 2}, {16, 64, 1}, {64, 64, 9}};
  EXPECT_EQ(fastestSubgroupSize(times), 32u) << "3 + 2 is less than 1 + 9";
  std::vector<WidthTime> better = times;
  better.push_back({64, 64, 3});
  EXPECT_EQ(fastestSubgroupSize(better), 64u);
  better.push_back({64, 8, 0.1});
  EXPECT_EQ(fastestSubgroupSize(better), 64u) << "8 was not timed with strands of 16";
  const std::vector<WidthTime> equal{{16, 64, 1}, {16, 32, 1}};
  EXPECT_EQ(fastestSubgroupSize(equal), 64u) << "the first of equals";
}

class SubgroupOption : public GpuTest {};

// What the device has gives what no choice gives; anything else is refused before kernels are made.
TEST_F(SubgroupOption, TakesWhatTheDeviceHas) {
  const auto groom = makeSwatch({});
  ASSERT_TRUE(groom) << groom.error().message;
  const auto create = [&](int width) {
    KernelChoice choice;
    choice.subgroupSize = width;
    return Simulation::create(device(), *groom, {}, {}, {}, choice);
  };
  const DeviceLimits limits = device().limits();
  auto automatic = create(0);
  auto stated = create(static_cast<int>(limits.subgroupSize));
  ASSERT_TRUE(automatic && stated);
  EXPECT_EQ(Diagnostics(*automatic).kernels(), Diagnostics(*stated).kernels());
  for (Simulation* simulation : {&*automatic, &*stated}) ASSERT_TRUE(simulation->stepFrame(HeadPose{}));
  EXPECT_EQ(*automatic->positions(), *stated->positions());
  const auto refused = create(3);
  ASSERT_FALSE(refused);
  expectParts(refused.error().message,
              {"a subgroup of 3 was asked for", std::to_string(limits.subgroupSize)});
}

// Where the driver promises nothing, subgroups may be wider than a strand's lanes: the same bits all the
// same.
TEST_F(SubgroupOption, LanesNeedNoPromisedSubgroups) {
  auto opened = gpu::Device::open("", {.withoutFullSubgroups = true});
  ASSERT_TRUE(opened) << opened.error().message;
  const ComputeDevice poor = ComputeDevice::over(*opened);
  EXPECT_EQ(subgroupSizes(poor.limits()).size(), 1u);
  SwatchParameters swatch;
  swatch.curl.particleCount = 16;
  const auto groom = makeSwatch(swatch);
  ASSERT_TRUE(groom) << groom.error().message;
  for (int lanes = 2; lanes <= static_cast<int>(poor.limits().subgroupSize) / 2; lanes *= 2) {
    KernelChoice choice;
    choice.form = KernelChoice::Form::lanes;
    choice.lanes = lanes;
    auto rich = Simulation::create(device(), *groom, {}, {}, {}, choice);
    auto plain = Simulation::create(poor, *groom, {}, {}, {}, choice);
    ASSERT_TRUE(rich && plain);
    for (Simulation* simulation : {&*rich, &*plain})
      ASSERT_TRUE(simulation->stepFrame(HeadPose{{0.01, 0, 0}, {}}));
    EXPECT_EQ(*rich->positions(), *plain->positions()) << lanes << " lanes";
  }
}

// On null hardware too, which only compiles: RADV_FORCE_FAMILY=navi21 has 32 and 64.
TEST(SubgroupKernels, CompileAtEveryWidth) {
  auto opened = gpu::Device::open("", {.allowNull = true});
  const char* required = std::getenv("RINGLET_REQUIRE_GPU");
  if (!opened && !(required && std::string(required) == "1"))
    GTEST_SKIP() << "SKIPPED, NOTHING WAS TESTED: " << opened.error().message;
  ASSERT_TRUE(opened) << opened.error().message;
  const DeviceLimits limits = ComputeDevice::over(*opened).limits();
  const bool canChoose = (*opened)->properties().canChooseSubgroupSize;
  for (const std::uint32_t width : subgroupSizes(limits)) {
    StrandKernelOptions options;
    options.subgroupSize = canChoose ? width : 0;
    const auto kernel = gpu::Kernel::create(**opened, describeStrandKernel({4, 4}, options));
    ASSERT_TRUE(kernel) << kernel.error().message;
    fmt::print("{}: subgroup {}, {}\n", (*opened)->properties().name, (*kernel)->subgroupSize(),
               (*kernel)->hasFullSubgroups() ? "full" : "not promised to be full");
    EXPECT_EQ((*kernel)->subgroupSize(), canChoose ? width : (*opened)->properties().reportedSubgroupSize);
    EXPECT_EQ((*kernel)->hasFullSubgroups(), (*opened)->properties().hasFullSubgroups);
  }
}

}  // namespace
}  // namespace ringlet::test::subgroup_choice_test
