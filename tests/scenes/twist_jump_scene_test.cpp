// twist_jump: a strand with a nearly flat fold. Frames on the smoothed strand turn smoothly from step to
// step; on the raw strand they jump, as an edge of the fold passes straight back along the one before it.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "layout/strands.h"
#include "ringlet/measure/frame_turn.h"
#include "ringlet/solver/diagnostics.h"
#include "tests/scenes/scene_runs.h"
#include "tests/support/tolerances.h"

namespace ringlet::test::twist_jump_scene_test {
namespace {

class TwistJump : public SceneTest {
 protected:
  // Largest angle any frame of the strand turns by in one step, by the device's own frames [degrees]. Those
  // that FrameTurn finds from the positions turn as far, or jump as well: how far is in the last digits.
  double largestTurn(bool smoothed, int particles, int steps) {
    auto made =
        makeScene("twist_jump",
                  {.particles = particles, .smoothedFrames = smoothed, .stepsPerFrame = steps, .seconds = 1});
    EXPECT_TRUE(made) << made.error().message;
    const BuiltinScene scene = frameByStep(std::move(*made));
    auto simulation =
        Simulation::create(device(), scene.groom, scene.material, scene.settings,
                           {.head = scene.motion.poseAt(0), .oneStepEarlier = HeadPose{}}, {.taps = true});
    EXPECT_TRUE(simulation) << simulation.error().message;
    double smallestCosine = 1;
    std::vector<std::array<float, 4>> before;
    FrameTurn measured(scene.groom, scene.material);
    for (int step = 0; step < scene.frameCount; ++step) {
      measured.look(*simulation->positions(), 1);  // a step's frames are those of its start
      EXPECT_TRUE(simulation->stepFrame(posesOfFrame(scene, step)));
      const auto frames = *Diagnostics(*simulation).tap(layout::kTapFrame);
      for (std::size_t i = 0; i + 2 < before.size(); ++i) {  // the last edge's frame holds none
        double cosine = 0;
        for (std::size_t k = 0; k < 4; ++k) cosine += double(before[i][k]) * frames[i][k];
        smallestCosine = std::min(smallestCosine, std::abs(cosine));
      }
      before = frames;
    }
    const double turn = 2 * std::acos(std::min(1.0, smallestCosine)) * 180 / std::numbers::pi;
    if (smoothed) {
      EXPECT_NEAR(measured.largest(), turn, kFrameTurnDegrees) << particles << " particles, " << steps;
    } else {
      EXPECT_GE(measured.largest(), 45) << particles << " particles, " << steps;
    }
    return turn;
  }

  std::vector<double> table(bool smoothed, int steps) {
    std::vector<double> turns;
    for (int particles : kResolutions) turns.push_back(largestTurn(smoothed, particles, steps));
    printRow(fmt::format("{} steps, {}", steps, smoothed ? "smoothed" : "raw"), turns, "{:.2f}");
    return turns;
  }
};

TEST_F(TwistJump, FramesAreContinuousOnTheSmoothedStrandAndJumpOnTheRaw) {
  printHeading("twist_jump, 1 s: largest turn of a frame in one step [degrees]");
  std::vector<double> coarse, fine;
  for (int steps : {8, 32}) {
    const std::vector<double> smoothed = table(true, steps), raw = table(false, steps);
    for (std::size_t k = 0; k < kResolutions.size(); ++k) {
      EXPECT_GE(raw[k], 45) << kResolutions[k] << " particles, " << steps << " steps";
      EXPECT_LE(smoothed[k], 20.0 * 8 / steps) << kResolutions[k] << " particles, " << steps << " steps";
    }
    (steps == 8 ? coarse : fine) = smoothed;
  }
  // Continuous: a quarter of the step gives a quarter of the turn.
  for (std::size_t k = 0; k < kResolutions.size(); ++k)
    EXPECT_NEAR(fine[k] / coarse[k], 0.25, 0.05) << kResolutions[k];
}

}  // namespace
}  // namespace ringlet::test::twist_jump_scene_test
