// bounce: a stretchy curl thrown up and down into its stretch limit, then left alone.
#include <cmath>

#include "tests/scenes/scene_runs.h"

namespace ringlet::test::bounce_scene_test {
namespace {

using Bounce = SceneTest;

TEST_F(Bounce, TheStretchLimitHoldsAndTheCurlComesBack) {
  for (int steps : kStepCounts) {
    std::vector<double> stretch, limited, core, settle, turns, energy;
    for (int particles : kResolutions) {
      const auto scene = makeScene("bounce", {.particles = particles, .stepsPerFrame = steps});
      ASSERT_TRUE(scene) << scene.error().message;
      const SceneRun run = this->run(*scene);
      stretch.push_back(run.report.maxEdgeStretch);
      limited.push_back(100 * run.report.limitedShare);
      core.push_back(run.numbers.worstCoreElongation);
      settle.push_back(run.numbers.settleSeconds.value_or(NAN));
      turns.push_back(run.numbers.turns);
      energy.push_back(run.numbers.energyRatio.value_or(NAN));
      EXPECT_LE(stretch.back(), scene->settings.maxStretch * (1 + 1e-4)) << particles << ", " << steps;
      EXPECT_GT(limited.back(), 0) << "the limit was never reached: " << particles << ", " << steps;
      EXPECT_NEAR(turns.back(), 8, 0.1) << particles << ", " << steps;
      EXPECT_LE(std::abs(run.numbers.tipRotation), 1) << particles << ", " << steps;
      EXPECT_TRUE(run.numbers.handednessKept) << particles << ", " << steps;
      EXPECT_LE(std::abs(run.numbers.droop), 1e-5) << particles << ", " << steps;
    }
    printHeading(fmt::format("bounce, 2 s and 6 s of rest, {} steps", steps));
    printRow("longest edge [x]", stretch, "{:.5f}");
    printRow("touched by the limit [%]", limited, "{:.3f}");
    printRow("core at the worst frame [x]", core, "{:.3f}");
    printRow("settled after [s]", settle, "{:.2f}");
    printRow("turns", turns, "{:.4f}");
    printRow("energy left of the peak", energy, "{:.1e}");
  }
}

}  // namespace
}  // namespace ringlet::test::bounce_scene_test
