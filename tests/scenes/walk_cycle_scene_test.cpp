// walk_cycle: a curl on a walking head swings but does not spin about itself (Iben et al. 2012, figure 2).
#include <cmath>

#include "tests/scenes/scene_runs.h"

namespace ringlet::test::walk_cycle_scene_test {
namespace {

class WalkCycle : public SceneTest {
 protected:
  SceneRun walk(bool smoothed, int steps) {
    const BuiltinScene scene =
        atAllResolutions("walk_cycle", {.smoothedFrames = smoothed, .stepsPerFrame = steps});
    SceneRun run = this->run(scene);
    const char* frames = smoothed ? "smoothed" : "raw";
    std::vector<double> last, worst, turns;
    for (const StrandMotion& strand : run.motion.strands) {
      last.push_back(strand.last.tipRotation);
      worst.push_back(strand.worst.tipRotation);
      turns.push_back(strand.last.turns);
    }
    printRow(fmt::format("{} steps, {}", steps, frames), last, "{:.2f}");
    printRow("  at the worst frame", worst, "{:.2f}");
    printRow("  turns at the end", turns, "{:.3f}");
    return run;
  }
};

TEST_F(WalkCycle, TheCurlDoesNotSpin) {
  printHeading("walk_cycle, 10 s: rotation of the tip about the core [degrees]");
  for (int steps : kStepCounts) {
    const SceneRun run = walk(true, steps);
    for (const StrandMotion& strand : run.motion.strands)
      EXPECT_LE(std::abs(strand.last.tipRotation), 5) << steps << " steps";
    EXPECT_TRUE(run.numbers.handednessKept);
  }
}

// Why frames follow the smoothed strand: on the raw strand the same walk spins the curl.
TEST_F(WalkCycle, FramesOnTheRawStrandSpinTheCurl) {
  printHeading("walk_cycle, 10 s, frames on the raw strand: rotation of the tip about the core [degrees]");
  const SceneRun run = walk(false, 8);
  for (const StrandMotion& strand : run.motion.strands) {
    EXPECT_GE(std::abs(strand.last.tipRotation), 90) << "where smoothed frames allow 5";
    EXPECT_LE(strand.last.turns, 7) << "of 8";
  }
}

}  // namespace
}  // namespace ringlet::test::walk_cycle_scene_test
