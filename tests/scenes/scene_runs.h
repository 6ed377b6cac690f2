// What the tests of built-in scenes share: running a scene on the device and measuring every frame.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "reference/step.h"
#include "ringlet/measure/motion_measure.h"
#include "ringlet/scenes/builtin_scene.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test {

inline const std::vector<int> kResolutions = {32, 64, 128, 256};  // particles a strand; 32 is four a turn
inline const std::vector<int> kStepCounts = {4, 8, 16, 32};       // a frame of 1/24 s

/// A scene after it ran. Paths and positions: relative to the head's origin, along world axes [m].
struct SceneRun {
  MotionReport motion;
  CurlNumbers numbers;
  SimulationReport report;
  std::vector<std::vector<Vec3d>> tips;  // of each strand, frame by frame, the start first
  std::vector<Vec3f> last;               // positions after the last frame, in groom order
};

inline std::vector<Vec3d> tipsOf(const Groom& groom, std::span<const Vec3f> positions) {
  std::vector<Vec3d> tips;
  for (std::size_t s = 0; s < groom.strandCount(); ++s)
    tips.push_back(Vec3d(positions[groom.firstPoint[s + 1] - 1]));
  return tips;
}

inline std::vector<HeadPose> posesOfFrame(const BuiltinScene& scene, int frame) {
  const Settings& settings = scene.settings;
  std::vector<HeadPose> poses;
  for (int k = 1; k <= settings.stepsPerFrame; ++k)
    poses.push_back(scene.motion.poseAt((frame * settings.stepsPerFrame + k) * settings.stepSeconds()));
  return poses;
}

/// The same scene with strands of all kResolutions in one groom, in that order.
inline BuiltinScene atAllResolutions(const char* name, SceneOptions options) {
  options.particles = kResolutions[0];
  auto scene = makeScene(name, options);
  EXPECT_TRUE(scene) << scene.error().message;
  for (std::size_t k = 1; k < kResolutions.size(); ++k) {
    options.particles = kResolutions[k];
    auto other = makeScene(name, options);
    EXPECT_TRUE(other) << other.error().message;
    scene->groom.addStrand(other->groom.strand(0));
  }
  return std::move(*scene);
}

/// The same steps as frames of their own, so that every step is seen.
inline BuiltinScene frameByStep(BuiltinScene scene) {
  scene.frameCount *= scene.settings.stepsPerFrame;
  scene.settings.framesPerSecond *= scene.settings.stepsPerFrame;
  scene.settings.stepsPerFrame = 1;
  return scene;
}

class SceneTest : public GpuTest {
 protected:
  SceneRun run(const BuiltinScene& scene) {
    SceneRun run;
    const HeadPose start = scene.motion.poseAt(0);
    auto simulation = Simulation::create(
        device(), scene.groom, scene.material, scene.settings,
        {.head = start, .oneStepEarlier = scene.motion.poseAt(-scene.settings.stepSeconds())});
    EXPECT_TRUE(simulation) << simulation.error().message;
    auto measure = MotionMeasure::make(scene.groom, {.framesPerSecond = scene.settings.framesPerSecond});
    EXPECT_TRUE(measure) << measure.error().message;
    run.tips.resize(scene.groom.strandCount());
    auto look = [&](const HeadPose& head) {
      auto positions = simulation->positions();
      ASSERT_TRUE(positions) << positions.error().message;
      const std::vector<Vec3d> tips = tipsOf(scene.groom, *positions);
      for (std::size_t s = 0; s < tips.size(); ++s) run.tips[s].push_back(tips[s]);
      run.last = *positions;
      for (Vec3f& p : *positions) p += Vec3f(head.position);
      const Status added = measure->addFrame(*positions, 1, head.rotation);
      ASSERT_TRUE(added) << added.error().message;
    };
    look(start);
    for (int frame = 0; frame < scene.frameCount && !::testing::Test::HasFatalFailure(); ++frame) {
      const std::vector<HeadPose> poses = posesOfFrame(scene, frame);
      const Status stepped = simulation->stepFrame(poses);
      EXPECT_TRUE(stepped) << stepped.error().message;
      look(poses.back());
    }
    run.motion = measure->report();
    run.numbers = curlNumbers(measure->ruler(), run.motion);
    run.report = *simulation->report();
    EXPECT_EQ(run.report.nonfinite, 0u);
    return run;
  }
};

/// Tip paths of the double reference, as SceneRun::tips.
inline std::vector<std::vector<Vec3d>> referenceTips(const BuiltinScene& scene) {
  reference::Simulation<double> simulation(scene.groom, scene.material, scene.settings,
                                           scene.motion.poseAt(0),
                                           scene.motion.poseAt(-scene.settings.stepSeconds()));
  std::vector<std::vector<Vec3d>> tips(scene.groom.strandCount());
  auto look = [&] {
    for (std::size_t s = 0; s < tips.size(); ++s) {
      const auto& p = simulation.positions()[scene.groom.firstPoint[s + 1] - 1];
      tips[s].push_back({p.x(), p.y(), p.z()});
    }
  };
  look();
  for (int frame = 0; frame < scene.frameCount; ++frame) {
    simulation.stepFrame(posesOfFrame(scene, frame));
    look();
  }
  return tips;
}

/// A line of a table: a heading and a number for each of kResolutions.
inline void printRow(const std::string& heading, const std::vector<double>& values, const char* format) {
  fmt::print("  {:<28}", heading);
  for (double value : values) fmt::print("{:>12}", fmt::format(fmt::runtime(format), value));
  fmt::print("\n");
}
inline void printHeading(const std::string& title) {
  fmt::print("{}\n  {:<28}", title, "particles");
  for (int particles : kResolutions) fmt::print("{:>12}", particles);
  fmt::print("\n");
}

}  // namespace ringlet::test
