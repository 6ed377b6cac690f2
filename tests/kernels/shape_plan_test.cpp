// Which strands run in which shape: that they fit, that it costs little more than it must, with few kernels.
// No device needed.
#include "ringlet/solver/plan/shape_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <tuple>

#include "ringlet/solver/strands/strand_kernels.h"

namespace ringlet::test::shape_plan_test {
namespace {

const DeviceLimits kLavapipe{8, true, true, 65535};
const DeviceLimits kDiscrete{32, true, false, 65535};
const DeviceLimits kDiscrete64{64, true, false, 65535};
const DeviceLimits kWithoutShuffle{32, false, false, 65535};
const DeviceLimits kShortRuns{.subgroupSize = 32, .hasSubgroupShuffle = true, .longestRunInMemory = 48};

std::vector<StrandRange> rangesOf(std::vector<std::uint32_t> counts, const DeviceLimits& limits,
                                  const KernelChoice& choice = {}, StrandWork work = StrandWork::hairAlone) {
  std::ranges::sort(counts);
  auto ranges = planRanges(counts, limits, choice, work);
  EXPECT_TRUE(ranges) << ranges.error().message;
  return ranges ? *ranges : std::vector<StrandRange>{};
}

StrandShape shapeOf(std::uint32_t particleCount, const DeviceLimits& limits, const KernelChoice& choice = {},
                    StrandWork work = StrandWork::hairAlone) {
  return rangesOf(std::vector(10'000, particleCount), limits, choice, work).at(0).shape;
}

// Of a step, by the model; without what kernels cost.
double costOf(const std::vector<StrandRange>& ranges, const DeviceLimits& limits) {
  const auto costs = shapeCosts(limits);
  double sum = 0;
  for (const StrandRange& range : ranges) {
    EXPECT_FALSE(range.shape.inMemory);
    sum += (range.end - range.begin) * std::ranges::find(costs, range.shape, &ShapeCost::shape)->nanoseconds;
  }
  return sum;
}

std::string messageOf(std::uint32_t particleCount, const KernelChoice& choice,
                      const DeviceLimits& limits = kLavapipe) {
  const auto ranges = planRanges(std::vector{particleCount}, limits, choice);
  return ranges ? "" : ranges.error().message;
}

TEST(ShapePlan, ShapesHoldTheirStrand) {
  for (const DeviceLimits& limits : {kLavapipe, kDiscrete, kWithoutShuffle}) {
    const std::uint32_t most = limits.hasSubgroupShuffle ? 1200 : kLongestRunInMemory;
    for (std::uint32_t n = 2; n <= most; ++n) {
      const StrandShape shape = shapeOf(n, limits);
      EXPECT_EQ(shape.inMemory,
                !limits.hasSubgroupShuffle || n > limits.subgroupSize * (limits.isCpu ? 32 : 16));
      EXPECT_EQ(shape.serial(), !limits.hasSubgroupShuffle);
      EXPECT_GE(shape.capacity(), n);
      EXPECT_LE(shape.lanes, limits.subgroupSize);
      EXPECT_EQ(shape.lanes & (shape.lanes - 1), 0u) << "lanes must be a power of two";
    }
  }
}

// Long runs on the CPU, one or two lanes where they do; many lanes on a GPU.
TEST(ShapePlan, RoundLengthsHaveRoundShapes) {
  EXPECT_EQ(shapeOf(16, kLavapipe), (StrandShape{1, 16}));
  EXPECT_EQ(shapeOf(32, kLavapipe), (StrandShape{1, 32}));
  EXPECT_EQ(shapeOf(64, kLavapipe), (StrandShape{2, 32}));
  EXPECT_EQ(shapeOf(64, kLavapipe, {}, StrandWork::volume), (StrandShape{2, 32}));
  EXPECT_EQ(shapeOf(64, kLavapipe, {}, StrandWork::plain), (StrandShape{4, 16}));
  EXPECT_EQ(shapeOf(16, kLavapipe, {}, StrandWork::bodies), (StrandShape{1, 16}));
  EXPECT_EQ(shapeOf(64, kLavapipe, {}, StrandWork::bodies), (StrandShape{4, 16}));
  EXPECT_EQ(shapeOf(256, kLavapipe, {}, StrandWork::plain), (StrandShape{8, 32}));
  EXPECT_EQ(shapeOf(256, kLavapipe, {}, StrandWork::bodies), (StrandShape{8, 32, true}));
  EXPECT_EQ(shapeOf(1000, kLavapipe), (StrandShape{8, 128, true}));
  EXPECT_EQ(shapeOf(1000, kDiscrete), (StrandShape{32, 32, true}));
  EXPECT_EQ(shapeOf(100, kWithoutShuffle), (StrandShape{1, 104, true}));
  EXPECT_EQ(shapeOf(128, kLavapipe), (StrandShape{8, 16}));
  EXPECT_EQ(shapeOf(32, kDiscrete), (StrandShape{8, 4}));
  EXPECT_EQ(shapeOf(64, kDiscrete), (StrandShape{16, 4}));
  EXPECT_EQ(shapeOf(128, kDiscrete), (StrandShape{32, 4}));
}

// What RADV 25 compiles for navi21, hair alone, in the step loop of a lane: vector instructions, and dwords
// spilled (loaded and stored). By scripts/count_instructions.sh, in subgroups of 32; 64 lanes in one of 64.
struct CompiledShape {
  StrandShape shape;
  int instructions, spilledDwords;
  double cost(double perDword = 15) const {  // of a strand, in instructions of a lane
    return shape.lanes * (instructions + perDword * spilledDwords);
  }
};
const CompiledShape kCompiled[] = {
    {{1, 4}, 1171, 0},    {{1, 8}, 2224, 92},     {{1, 16}, 4361, 577},   {{2, 4}, 1618, 0},
    {{2, 8}, 2833, 69},   {{2, 16}, 5278, 622},   {{4, 4}, 2245, 0},      {{4, 8}, 3853, 160},
    {{4, 16}, 7119, 933}, {{8, 4}, 2530, 4},      {{8, 8}, 4141, 261},    {{8, 16}, 7408, 2635},
    {{16, 4}, 2907, 26},  {{16, 8}, 4512, 363},   {{16, 16}, 7779, 2638}, {{32, 4}, 3267, 40},
    {{32, 8}, 4882, 453}, {{32, 16}, 8146, 2625}, {{64, 4}, 5095, 50},    {{64, 8}, 6703, 614},
};
double cheapestCompiled(std::uint32_t particleCount, const DeviceLimits& limits, double perDword) {
  double cheapest = std::numeric_limits<double>::infinity();
  for (const CompiledShape& c : kCompiled) {
    if (c.shape.lanes <= limits.subgroupSize && c.shape.capacity() >= particleCount)
      cheapest = std::min(cheapest, c.cost(perDword));
  }
  return cheapest;
}

// Within a fifth up to runs of 8. Runs of 16 spill most of what they hold, and the model is up to two fifths
// too low: they are for strands that nothing shorter holds. Left out are 64 lanes, whose shuffles are dearer.
TEST(ShapePlan, AGpusModelIsWhatIsCompiled) {
  const auto costs = shapeCosts(kDiscrete);
  for (const CompiledShape& c : kCompiled) {
    if (c.shape.lanes > kDiscrete.subgroupSize) continue;
    const double model = std::ranges::find(costs, c.shape, &ShapeCost::shape)->nanoseconds;
    const double compiled = 1.25e-3 * c.cost();
    const double within = c.shape.particlesPerLane <= 8 ? 0.2 : 0.4;
    EXPECT_NEAR(model / compiled, 1, within) << c.shape.describe();
  }
}

// Nothing that was compiled is much cheaper than the choice, as long as a spilled dword costs 10 to 30
// instructions. So many strands that what a kernel takes to prepare does not matter.
TEST(ShapePlan, AGpuGetsTheCheapestOfWhatIsCompiled) {
  for (const DeviceLimits& limits : {kDiscrete, kDiscrete64}) {
    for (const std::uint32_t n : {16u, 32u, 64u, 100u, 128u, 256u, 512u}) {
      const StrandShape shape = rangesOf(std::vector(100'000, n), limits).at(0).shape;
      const auto chosen = std::ranges::find(kCompiled, shape, &CompiledShape::shape);
      ASSERT_NE(chosen, std::end(kCompiled)) << n << " particles: " << shape.describe() << " was not counted";
      for (const double perDword : {10.0, 15.0, 30.0}) {
        EXPECT_LE(chosen->cost(perDword), 1.25 * cheapestCompiled(n, limits, perDword))
            << n << " particles, " << shape.describe() << ", a dword costs " << perDword;
      }
    }
  }
}

// As many particles of 16 to 128 a strand, some 110,000 of them and 1,130, as of 72.
TEST(ShapePlan, MixedLengthsCostLittleMoreThanEqualOnes) {
  for (const auto& [each, ratio, mostKernels] : {std::tuple{1000, 1.15, 24u}, {10, 1.3, 5u}}) {
    std::vector<std::uint32_t> counts;
    for (std::uint32_t n = 16; n <= 128; ++n) counts.insert(counts.end(), each, n);
    const std::vector<std::uint32_t> equal(counts.size(), 72);
    const auto ranges = rangesOf(counts, kLavapipe);
    EXPECT_LE(costOf(ranges, kLavapipe), ratio * costOf(rangesOf(equal, kLavapipe), kLavapipe)) << each;
    EXPECT_LE(ranges.size(), mostKernels) << "kernels, " << each;
  }
}

// What a start takes is more than what a few strands do.
TEST(ShapePlan, FewStrandsGetAKernelThatIsSoonThere) {
  EXPECT_EQ(rangesOf(std::vector(40, 64u), kLavapipe).at(0).shape, (StrandShape{8, 8}));
  EXPECT_EQ(rangesOf(std::vector(1000, 64u), kLavapipe).at(0).shape, (StrandShape{2, 32}));
  EXPECT_EQ(rangesOf(std::vector(1000, 128u), kLavapipe).at(0).shape, (StrandShape{8, 16}));
}

TEST(ShapePlan, FewStrandsOfManyHeadsGetTheKernelOfManyStrands) {
  EXPECT_EQ(rangesOf(std::vector(40, 64u), kLavapipe, {.heads = 25}).at(0).shape,
            rangesOf(std::vector(1000, 64u), kLavapipe).at(0).shape);
}

TEST(ShapePlan, ACpusWorkgroupsAreSubgroupsWhereStrandsAreFew) {
  for (const std::uint32_t width : {4u, 8u, 16u, 32u}) {
    EXPECT_EQ(strandGroupSize({.subgroupSize = width, .isCpu = true}, 400), std::max(8u, width));
    EXPECT_EQ(strandGroupSize({.subgroupSize = width, .isCpu = true}, 4000), kStrandGroupSize);
    EXPECT_EQ(strandGroupSize({.subgroupSize = width}, 400), kStrandGroupSize);
  }
}

TEST(ShapePlan, FewStrandsOrNearlyEqualOnesGetOneKernel) {
  std::vector<std::uint32_t> few, alike;
  for (std::uint32_t n = 16; n <= 128; n += 8) few.push_back(n);
  for (std::uint32_t s = 0; s < 1000; ++s) alike.push_back(60 + s % 5);
  EXPECT_EQ(rangesOf(few, kLavapipe).size(), 1u);
  EXPECT_EQ(rangesOf(alike, kLavapipe).size(), 1u);
  EXPECT_GT(rangesOf(few, kLavapipe, {.manyKernels = true}).size(), 5u);
}

// Every way to give three lengths a shape each.
TEST(ShapePlan, NoOtherChoiceIsCheaper) {
  const DeviceLimits limits{2, true, true, 65535};
  const auto kernelCost = [](const StrandShape& shape) {  // as the model has it
    return 5'000 + 3'000.0 * shape.particlesPerLane;
  };
  auto costs = shapeCosts(limits);
  costs.pop_back();  // registers hold all
  for (const auto& [a, b, c, each] : {std::array{9u, 17u, 30u, 40u},
                                      {4u, 5u, 6u, 1000u},
                                      {16u, 17u, 32u, 600u},
                                      {2u, 20u, 24u, 300u},
                                      {10u, 11u, 32u, 2000u}}) {
    const std::uint32_t lengths[] = {a, b, c};
    std::vector<std::uint32_t> counts;
    for (std::uint32_t n : lengths) counts.insert(counts.end(), each, n);
    double cheapest = std::numeric_limits<double>::infinity();
    std::size_t chosen[3];
    for (chosen[0] = 0; chosen[0] < costs.size(); ++chosen[0]) {
      for (chosen[1] = 0; chosen[1] < costs.size(); ++chosen[1]) {
        for (chosen[2] = 0; chosen[2] < costs.size(); ++chosen[2]) {
          double cost = 0;
          for (const std::size_t shape : std::set(chosen, chosen + 3)) cost += kernelCost(costs[shape].shape);
          for (int k = 0; k < 3; ++k) {
            const ShapeCost& shape = costs[chosen[k]];
            const bool fits = shape.shape.capacity() >= lengths[k];
            cost += fits ? each * shape.nanoseconds : std::numeric_limits<double>::infinity();
          }
          cheapest = std::min(cheapest, cost);
        }
      }
    }
    const auto ranges = rangesOf(counts, limits);
    double found = costOf(ranges, limits);
    for (const StrandRange& range : ranges) found += kernelCost(range.shape);
    EXPECT_NEAR(found, cheapest, 1e-9 * cheapest) << a << ' ' << b << ' ' << c;
  }
}

TEST(ShapePlan, MeasuredCostsDecide) {
  const ShapeCost measured[] = {{{2, 32}, 900}, {{8, 8}, 700}};
  const KernelChoice tuned{.measured = measured};
  EXPECT_EQ(shapeOf(64, kLavapipe, tuned), (StrandShape{8, 8}));
  const auto costs = shapeCosts(kLavapipe, StrandWork::hairAlone, tuned.measured);
  EXPECT_EQ(std::ranges::find(costs, StrandShape{8, 8}, &ShapeCost::shape)->nanoseconds, 700);
  // What was not measured keeps its proportion to the rest: the mean of these two.
  const auto model = shapeCosts(kLavapipe);
  const auto ratio = [&](StrandShape shape) {
    return std::ranges::find(costs, shape, &ShapeCost::shape)->nanoseconds /
           std::ranges::find(model, shape, &ShapeCost::shape)->nanoseconds;
  };
  EXPECT_NEAR(ratio({2, 16}), std::sqrt(ratio({2, 32}) * ratio({8, 8})), 1e-12);
  const ShapeCost quickSerial[] = {{kAnySerialShape, 1}, {{2, 32}, 900}};
  EXPECT_TRUE(shapeOf(64, kLavapipe, {.measured = quickSerial}).serial());
}

// They take long to make.
TEST(ShapePlan, TheLongestRunsMustBeAskedForOrMeasured) {
  EXPECT_EQ(shapeOf(64, kLavapipe, {.lanes = 1}), (StrandShape{1, 64}));
  EXPECT_EQ(shapeOf(300, kLavapipe, {KernelChoice::Form::lanes}), (StrandShape{8, 38}));
  const ShapeCost measured[] = {{{2, 32}, 550}, {{1, 64}, 500}};
  EXPECT_EQ(shapeOf(64, kLavapipe, {.measured = measured}), (StrandShape{1, 64}));
  EXPECT_EQ(shapeOf(50, kLavapipe, {.measured = measured}), (StrandShape{2, 25})) << "1 x 50 was not";
  EXPECT_EQ(shapeOf(64, kLavapipe, {.measured = measured}, StrandWork::plain), (StrandShape{4, 16}))
      << "of hair alone";
}

TEST(ShapePlan, StatedLanesAndRunsAreKept) {
  EXPECT_EQ(shapeOf(30, kLavapipe, {.lanes = 8}), (StrandShape{8, 4}));
  EXPECT_EQ(shapeOf(30, kLavapipe, {.particlesPerLane = 5}), (StrandShape{8, 5}));
  EXPECT_EQ(shapeOf(30, kLavapipe, {.particlesPerLane = 15, .lanes = 4}), (StrandShape{4, 15}));
  const auto ranges = rangesOf({10, 16, 17, 64}, kLavapipe, {.particlesPerLane = 16, .lanes = 1});
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_EQ(ranges[0].end, 2u);
  EXPECT_EQ(ranges[1].shape, (StrandShape{8, 8, true}));
}

TEST(ShapePlan, RunsAreInMemoryWhereThatIsAskedFor) {
  using Form = KernelChoice::Form;
  EXPECT_TRUE(shapeOf(64, kLavapipe, {Form::serial}).serial());
  EXPECT_EQ(shapeOf(64, kLavapipe, {Form::serial}).describe(), "serial 1 x 64");
  EXPECT_TRUE(shapeOf(64, kLavapipe, {Form::memory}).inMemory);
  EXPECT_EQ(shapeOf(64, kLavapipe, {Form::memory, 70, 2}), (StrandShape{2, 70, true}));
  EXPECT_EQ(shapeOf(300, kLavapipe, {.form = Form::memory, .lanes = 4}), (StrandShape{4, 80, true}));
  EXPECT_EQ(shapeOf(300, kLavapipe, {.form = Form::memory, .lanes = 4}).describe(), "memory 4 x 80");
}

// What registers hold stays there, whatever stands beside it.
TEST(ShapePlan, OnlyLongStrandsHaveTheirRunsInMemory) {
  std::vector<std::uint32_t> counts(500, 64);
  counts.insert(counts.end(), 500, 400);
  const auto ranges = rangesOf(counts, kLavapipe);
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_EQ(ranges[0].shape, shapeOf(64, kLavapipe));
  EXPECT_EQ(ranges[1].shape, (StrandShape{8, 56, true}));
}

TEST(ShapePlan, RefusesWhatCannotBe) {
  using Form = KernelChoice::Form;
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(messageOf(600, {Form::lanes}), "600 particles does not fit: 8 lanes of 64 hold 512");
  has(messageOf(130, {.form = Form::lanes, .lanes = 2}), "2 lanes of 64 hold 128");
  has(messageOf(64, {Form::automatic, 3}), "3 particles per lane was asked for; 4 to 64");
  has(messageOf(64, {Form::automatic, 65}), "65 particles per lane");
  has(messageOf(64, {Form::serial, 1025}), "1025 particles per lane was asked for; 4 to 1024");
  has(messageOf(1025, {Form::serial}),
      "1025 particles does not fit this device: 1 lane of 1024 in memory hold 1024");
  has(messageOf(8193, {}), "8193 particles does not fit this device: 8 lanes of 1024 in memory hold 8192");
  has(messageOf(64, {Form::serial, 50}, kShortRuns), "50 particles per lane was asked for; 4 to 48");
  has(messageOf(49, {Form::serial}, kShortRuns), "1 lane of 48 in memory hold 48");
  has(messageOf(1537, {}, kShortRuns),
      "1537 particles does not fit this device: 32 lanes of 48 in memory hold 1536");
  for (int lanes : {-1, 3, 16}) has(messageOf(64, {.lanes = lanes}), "this device can have 1, 2, 4 or 8");
}

}  // namespace
}  // namespace ringlet::test::shape_plan_test
