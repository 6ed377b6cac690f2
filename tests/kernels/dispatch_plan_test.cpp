// How a groom is cut into dispatches: every strand and step exactly once, within the device's limits. No
// device needed.
#include "ringlet/solver/dispatch_plan.h"

#include <gtest/gtest.h>

#include <numeric>

#include "shared/layout.h"

namespace ringlet::test {
namespace {

const DeviceLimits kLavapipe{8, true, true, 65535, true};
const DeviceLimits kDiscrete{32, true, false, 65535};
const DeviceLimits kWithoutShuffle{32, false, false, 65535};

TEST(DispatchPlan, EveryStrandAndStepOnce) {
  std::vector<std::uint32_t> counts;
  for (std::uint32_t n : {2u, 10u, 16u, 17u, 64u, 65u, 128u, 129u, 1000u}) counts.insert(counts.end(), 5, n);
  for (Integrator integrator : {Integrator::jacobi, Integrator::pointJacobi, Integrator::paper}) {
    for (DeviceLimits limits : {kLavapipe, kDiscrete, kWithoutShuffle}) {
      limits.maxGroupCount = 1;  // so that ranges are split too
      Settings settings;
      settings.integrator = integrator;
      settings.stepsPerFrame = 300;
      const auto ranges = planRanges(counts, limits, {.manyKernels = true});
      ASSERT_TRUE(ranges) << ranges.error().message;
      const auto plan = planFrame(*ranges, limits, settings, 0, 64);
      ASSERT_TRUE(plan) << plan.error().message;
      std::vector<std::uint32_t> nextStep(counts.size(), 0), nextLoop(counts.size(), 0);
      for (const PlannedDispatch& d : *plan) {
        EXPECT_LE(d.groupCount, limits.maxGroupCount);
        const StrandShape& shape = (*ranges)[d.range].shape;
        EXPECT_GE(d.groupCount * 64 / std::max(1u, shape.lanes), d.strandEnd - d.strandBegin);
        for (std::uint32_t s = d.strandBegin; s < d.strandEnd; ++s) {
          EXPECT_EQ(d.stepBegin, nextStep[s]) << "strand " << s;
          if (d.phases & layout::kPhaseSolve) {
            EXPECT_EQ(d.loopBegin, nextLoop[s]);
            nextLoop[s] = d.loopEnd;
          }
          if (d.phases & layout::kPhaseMove) {
            const int loops = integrator == Integrator::jacobi        ? 0
                              : integrator == Integrator::pointJacobi ? settings.pointIterations
                                                                      : settings.forceLoops;
            EXPECT_EQ(nextLoop[s], static_cast<std::uint32_t>(loops));
            nextLoop[s] = 0;
            nextStep[s] = d.stepEnd;
          }
        }
      }
      for (std::uint32_t step : nextStep) EXPECT_EQ(step, 300u);
    }
  }
}

TEST(DispatchPlan, RefusesWhatCannotBe) {
  Settings settings;
  settings.integrator = Integrator::paper;
  const auto ranges = planRanges(std::vector<std::uint32_t>{20000}, kLavapipe, {});
  ASSERT_TRUE(ranges);
  EXPECT_NE(planFrame(*ranges, kLavapipe, settings, 0, 64).error().message.find("20000 particles"),
            std::string::npos);
}

}  // namespace
}  // namespace ringlet::test
