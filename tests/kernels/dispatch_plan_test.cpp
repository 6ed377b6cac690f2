// How a groom is cut into dispatches: every strand and step exactly once, within the device's limits. No
// device needed.
#include "ringlet/solver/plan/dispatch_plan.h"

#include <gtest/gtest.h>

#include <numeric>

namespace ringlet::test::dispatch_plan_test {
namespace {

const DeviceLimits kLavapipe{8, true, true, 65535, true};
const DeviceLimits kDiscrete{32, true, false, 65535};
const DeviceLimits kWithoutShuffle{32, false, false, 65535};

// Turns of loops that the shaders make at least for one lane in a dispatch, as their text has them, and
// lavapipe's end to them. A sweep is a turn for each particle of a run, counted in full, though drivers
// unroll what is in registers.
constexpr std::uint64_t kEndOfLoops = 65535;
std::uint64_t turnsOf(const PlannedDispatch& d, const StrandShape& shape, const Settings& settings,
                      std::uint64_t bodies) {
  const std::uint64_t n = shape.particlesPerLane + (shape.inMemory ? 1 : 0);  // asked once more than it turns
  std::uint64_t step = 15 * n;  // forces, the move and its limit
  if (settings.integrator == Integrator::pointJacobi) step += settings.pointIterations * (1 + n);
  if (settings.integrator == Integrator::paper) {
    const std::uint64_t damping = 1 + (shape.lanes == 1 ? 3 : 4) * n;
    step += settings.forceLoops * (1 + n + settings.dampingLoops * damping);
  }
  // Bodies in the way. In registers a lane looks 17 times for each particle and each edge, for the solve and
  // after the move. In memory a body is traced for each particle and edge of a long run at worst (18 turns
  // each); then there are eight rounds of four sweeps, with a trace, a way out of 4 turns and a look at an
  // edge.
  if (bodies > 0)
    step += shape.inMemory ? n * (12 + 36 * bodies + 8 * (4 + 23 * bodies)) : n * 4 * 17 * bodies;
  return (d.stepEnd - d.stepBegin) * (1 + step);
}

// Neither without nor with bodies, of which four are in the way.
TEST(DispatchPlan, NoDispatchLoopsLongerThanLavapipeLets) {
  std::vector<std::uint32_t> counts;
  for (std::uint32_t n : {2u, 10u, 17u, 64u, 129u, 400u}) counts.insert(counts.end(), 3, n);
  for (Integrator integrator : {Integrator::jacobi, Integrator::pointJacobi, Integrator::paper}) {
    for (const KernelChoice::Form form :
         {KernelChoice::Form::automatic, KernelChoice::Form::memory, KernelChoice::Form::serial}) {
      for (const std::uint64_t bodies : {0, 1, 4}) {
        if (bodies > 0 && integrator != Integrator::jacobi) continue;
        Settings settings;
        settings.integrator = integrator;
        settings.stepsPerFrame = 300;
        const bool hasFewLanes = form != KernelChoice::Form::automatic;
        settings.pointIterations = hasFewLanes ? 120 : 1000;
        if (hasFewLanes) settings.forceLoops = 4;
        const auto ranges = planRanges(counts, kLavapipe, {.form = form, .manyKernels = true});
        ASSERT_TRUE(ranges) << ranges.error().message;
        const auto plan = planFrame(*ranges, {kLavapipe, 64}, settings, bodies);
        ASSERT_TRUE(plan) << plan.error().message;
        for (const PlannedDispatch& d : *plan) {
          const StrandRange& range = (*ranges)[d.range];
          // A step is the least there is; of the longest strands it may be too long at worst.
          if (bodies > 0 && range.shape.inMemory && d.stepEnd == d.stepBegin + 1) continue;
          EXPECT_LE(turnsOf(d, range.shape, settings, bodies), kEndOfLoops)
              << range.shape.describe() << ", integrator " << int(integrator) << ", " << bodies << " bodies, "
              << d.stepEnd - d.stepBegin << " steps";
        }
      }
    }
  }
}

TEST(DispatchPlan, EveryStrandAndStepOnce) {
  std::vector<std::uint32_t> counts;
  for (std::uint32_t n : {2u, 10u, 16u, 17u, 64u, 65u, 128u, 129u, 700u}) counts.insert(counts.end(), 5, n);
  for (Integrator integrator : {Integrator::jacobi, Integrator::pointJacobi, Integrator::paper}) {
    for (DeviceLimits limits : {kLavapipe, kDiscrete, kWithoutShuffle}) {
      limits.maxGroupCount = 1;  // so that ranges are split too
      Settings settings;
      settings.integrator = integrator;
      settings.stepsPerFrame = 300;
      const auto ranges = planRanges(counts, limits, {.manyKernels = true});
      ASSERT_TRUE(ranges) << ranges.error().message;
      const auto plan = planFrame(*ranges, {limits, 64}, settings, 0);
      ASSERT_TRUE(plan) << plan.error().message;
      std::vector<std::uint32_t> nextStep(counts.size(), 0);
      for (const PlannedDispatch& d : *plan) {
        EXPECT_LE(d.groupCount, limits.maxGroupCount);
        const StrandShape& shape = (*ranges)[d.range].shape;
        EXPECT_GE(d.groupCount * 64 / shape.lanes, d.strandEnd - d.strandBegin);
        for (std::uint32_t s = d.strandBegin; s < d.strandEnd; ++s) {
          EXPECT_EQ(d.stepBegin, nextStep[s]) << "strand " << s;
          nextStep[s] = d.stepEnd;
        }
      }
      for (std::uint32_t step : nextStep) EXPECT_EQ(step, 300u);
    }
  }
}

TEST(DispatchPlan, RefusesWhatCannotBe) {
  Settings settings;
  settings.integrator = Integrator::paper;
  const auto messageOf = [&](const KernelChoice& choice) {
    const auto ranges = planRanges(std::vector<std::uint32_t>{1000}, kLavapipe, choice);
    EXPECT_TRUE(ranges) << ranges.error().message;
    return planFrame(*ranges, {kLavapipe, 64}, settings, 0).error().message;
  };
  for (const char* part : {"1000 particles", "loop turns", "use the jacobi integrator"})
    EXPECT_NE(messageOf({}).find(part), std::string::npos) << messageOf({});
  EXPECT_NE(messageOf({KernelChoice::Form::serial}).find("use more lanes"), std::string::npos);
}

}  // namespace
}  // namespace ringlet::test::dispatch_plan_test
