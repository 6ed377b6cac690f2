// How a groom is cut into dispatches: every strand and step exactly once, within the device's limits. No
// device needed.
#include "ringlet/solver/dispatch_plan.h"

#include <gtest/gtest.h>

#include <numeric>

#include "shared/layout.h"

namespace ringlet::test {
namespace {

const DeviceLimits kLavapipe{8, true, true, 65535};
const DeviceLimits kDiscrete{32, true, false, 65535};
const DeviceLimits kWithoutShuffle{32, false, false, 65535};

// Turns of loops that the shaders may make for one strand or lane in a dispatch, as their text has them, and
// lavapipe's end to them. A sweep is a turn for each particle of a strand (serial) or a run (lanes); lanes
// count theirs in full, though most drivers unroll them.
constexpr std::uint64_t kEndOfLoops = 65535;
std::uint64_t turnsOf(const PlannedDispatch& d, const StrandShape& shape, std::uint32_t longest,
                      const Settings& settings, std::uint64_t bodies) {
  const std::uint64_t n = shape.serial() ? longest : shape.particlesPerLane;
  const std::uint64_t steps = d.stepEnd - d.stepBegin, loops = d.loopEnd - d.loopBegin;
  std::uint64_t step = 0;
  if (d.phases & layout::kPhaseSprings) step += 3 * n;  // velocities; springs; core
  if (d.phases & layout::kPhaseMove) step += n;
  if (settings.integrator == Integrator::jacobi) step += 2 * n;  // there and back
  if (settings.integrator == Integrator::pointJacobi) {
    step += loops * (1 + n) + ((d.phases & layout::kPhaseSprings) ? 2 * n : 0);
  }
  if (settings.integrator == Integrator::paper) {
    step += loops * (1 + n + static_cast<std::uint64_t>(settings.dampingLoops) * (1 + 2 * n));
  }
  // Bodies in the way. A lane looks 17 times for each particle and each edge, for the solve and after the
  // move. Serial: two more solves and four sweeps; a body is traced for each particle and edge (18 turns
  // each); then eight rounds of three sweeps, with a trace, a way out of 4 turns and a look at an edge for
  // each body, and seven sweeps of the stretch limit between.
  if (bodies > 0 && shape.serial()) step += n * (4 + 4 + 36 * bodies + 8 * (3 + 23 * bodies) + 7);
  if (bodies > 0 && !shape.serial()) step += n * 4 * 17 * bodies;
  return steps * (1 + step);
}

// Neither without nor with bodies, of which four are in the way.
TEST(DispatchPlan, NoDispatchLoopsLongerThanLavapipeLets) {
  std::vector<std::uint32_t> counts;
  for (std::uint32_t n : {2u, 10u, 17u, 64u, 129u, 400u}) counts.insert(counts.end(), 3, n);
  for (Integrator integrator : {Integrator::jacobi, Integrator::pointJacobi, Integrator::paper}) {
    for (const KernelChoice::Form form : {KernelChoice::Form::automatic, KernelChoice::Form::serial}) {
      for (const std::uint64_t bodies : {0, 1, 4}) {
        if (bodies > 0 && integrator != Integrator::jacobi) continue;
        Settings settings;
        settings.integrator = integrator;
        settings.stepsPerFrame = 300;
        settings.pointIterations = 1000;
        const auto ranges = planRanges(counts, kLavapipe, {.form = form, .manyKernels = true});
        ASSERT_TRUE(ranges) << ranges.error().message;
        const auto plan = planFrame(*ranges, kLavapipe, settings, bodies, 64);
        ASSERT_TRUE(plan) << plan.error().message;
        for (const PlannedDispatch& d : *plan) {
          const StrandRange& range = (*ranges)[d.range];
          // A step is the least there is; of the longest strands it may be too long at worst.
          if (bodies > 0 && range.shape.serial() && d.stepEnd == d.stepBegin + 1) continue;
          EXPECT_LE(turnsOf(d, range.shape, range.longest, settings, bodies), kEndOfLoops)
              << range.shape.describe() << ", integrator " << int(integrator) << ", " << bodies << " bodies, "
              << d.stepEnd - d.stepBegin << " steps, " << d.loopEnd - d.loopBegin << " loops";
        }
      }
    }
  }
}

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
