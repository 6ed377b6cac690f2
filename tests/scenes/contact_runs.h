// What the tests of scenes in which hair meets hair share: a scene run step by step and watched for contacts.
#pragma once

#include <string>

#include "ringlet/measure/contact_watch.h"
#include "tests/scenes/scene_runs.h"

namespace ringlet::test {

struct ContactRun {
  ContactNumbers numbers;
  ContactReport report;       // at the end
  double momentumError = 0;   // of the worst frame's last step
  double energyRatio = 0;     // kinetic energy at the end over its peak
  double worstRootError = 0;  // of a root's place [m]
};

class ContactSceneTest : public SceneTest {
 protected:
  /// The first `seconds` of a scene; what it shows is printed as a line of a table.
  ContactRun watch(const char* name, const SceneOptions& options) {
    const auto made = makeScene(name, options);
    EXPECT_TRUE(made) << made.error().message;
    const ContactRun run = watch(*made);
    fmt::print(
        "{}, {} steps, contacts {}: deepest overlap {:.3f}, crossings {}, momentum error {:.3f}, energy left "
        "{:.1e}, {} rebuilds, {} pair tests\n",
        name, made->settings.stepsPerFrame, made->settings.contacts.on ? "on" : "off",
        run.numbers.deepestOverlap, run.numbers.crossings, run.momentumError, run.energyRatio,
        run.report.rebuilds, run.report.pairTests);
    return run;
  }

  ContactRun watch(const BuiltinScene& scene) {
    ContactRun run;
    const BuiltinScene steps = frameByStep(scene);
    const double T = steps.settings.stepSeconds();
    auto simulation = Simulation::create(device(), steps.groom, steps.material, steps.settings,
                                         {.head = scene.motion.poseAt(0),
                                          .oneStepEarlier = scene.motion.poseAt(-T),
                                          .rootShifts = scene.rootShifts});
    EXPECT_TRUE(simulation) << simulation.error().message;
    auto watch = ContactWatch::make(scene.groom, scene.material, scene.settings);
    EXPECT_TRUE(watch) << watch.error().message;
    auto measure = MotionMeasure::make(scene.groom, {.framesPerSecond = scene.settings.framesPerSecond});
    EXPECT_TRUE(measure) << measure.error().message;

    std::vector<Vec3f> positions = *simulation->positions();
    watch->addStep(positions);
    EXPECT_TRUE(measure->addFrame(positions, 1));
    for (int step = 1; step <= scene.frameCount * scene.settings.stepsPerFrame; ++step) {
      const HeadPose head = scene.motion.poseAt(step * T);
      const Status stepped = simulation->stepFrame(std::span(&head, 1));
      EXPECT_TRUE(stepped) << stepped.error().message;
      positions = *simulation->positions();
      watch->addStep(positions);
      if (step % scene.settings.stepsPerFrame != 0) continue;
      if (watch->endFrame()) run.momentumError = simulation->contactReport()->momentumError;
      run.worstRootError = std::max(run.worstRootError, rootError(scene, head, positions));
      EXPECT_TRUE(measure->addFrame(positions, 1, head.rotation));
    }
    run.numbers = watch->numbers();
    run.report = *simulation->contactReport();
    run.energyRatio = measure->report().energyRatio;
    EXPECT_EQ(simulation->report()->nonfinite, 0u);
    return run;
  }

 private:
  // How far a root is from where the head and its own shift take it [m].
  static double rootError(const BuiltinScene& scene, const HeadPose& head, std::span<const Vec3f> positions) {
    double worst = 0;
    for (std::size_t s = 0; s < scene.groom.strandCount(); ++s) {
      Vec3d root = Vec3d(scene.groom.strand(s)[0]) * scene.groom.metresPerUnit;
      if (!scene.rootShifts.empty()) root += scene.rootShifts[s] * head.shift;
      const Vec3d found(positions[scene.groom.firstPoint[s]]);
      worst = std::max(worst, length(found - rotate(head.rotation, root)));
    }
    return worst;
  }
};

/// What hair that meets hair must keep to: sphere centres no nearer than this share of R beyond rest, which
/// leaves no way between two of them that stand R apart.
inline constexpr double kDeepestOverlap = 0.30;
inline constexpr double kRootPlace = 1e-6;  // [m]: a float's rounding at 0.3 m, a few times

inline void expectKeptApart(const ContactRun& run) {
  EXPECT_EQ(run.numbers.crossings, 0u);
  EXPECT_LT(run.numbers.deepestOverlap, kDeepestOverlap);
  EXPECT_GT(run.numbers.worst.overlapBeyondRestSum, 0) << "hair must meet";
  EXPECT_LE(run.worstRootError, kRootPlace);
}

}  // namespace ringlet::test
