// Hair on a head that follows keyframes (scene/keyframes.h): the frame rate changes nothing, and a steady
// motion gives no jitter, though its keys are 24 a second.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "ringlet/groom/generate.h"
#include "ringlet/rest/material_presets.h"
#include "ringlet/scene/motion.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::keyframe_motion_test {
namespace {

constexpr double kStepsPerSecond = 192;
constexpr double kLength = 0.25;  // of the curl's core [m]

Motion along(std::vector<HeadPose> poses) {
  return {.kind = MotionKind::keyframes,
          .keyframes = std::make_shared<const Keyframes>(Keyframes{1.0 / 24, std::move(poses)})};
}

class KeyframeMotion : public GpuTest {
 protected:
  // Calls seen(positions, head) after every frame.
  template <class Seen>
  void run(const Motion& motion, double framesPerSecond, double seconds, Seen&& seen) {
    const auto curl = makeCurl({});
    ASSERT_TRUE(curl) << curl.error().message;
    Settings settings;
    settings.framesPerSecond = framesPerSecond;
    settings.stepsPerFrame = static_cast<int>(std::lround(kStepsPerSecond / framesPerSecond));
    auto simulation = Simulation::create(
        device(), *curl, materialPreset("ringlet").value(), settings,
        {.head = motion.poseAt(0), .oneStepEarlier = motion.poseAt(-settings.stepSeconds())});
    ASSERT_TRUE(simulation) << simulation.error().message;
    for (int frame = 0; frame < static_cast<int>(std::lround(seconds * framesPerSecond)); ++frame) {
      std::vector<HeadPose> poses;
      for (int k = 1; k <= settings.stepsPerFrame; ++k)
        poses.push_back(motion.poseAt((frame * settings.stepsPerFrame + k) / kStepsPerSecond));
      ASSERT_TRUE(simulation->stepFrame(poses));
      seen(*simulation->positions(), simulation->head());
    }
  }
};

TEST_F(KeyframeMotion, TheFrameRateChangesNothing) {
  std::vector<HeadPose> poses;
  for (int k = 0; k <= 48; ++k)
    poses.push_back({{0.1 * std::sin(0.5 * k), 0.03 * std::cos(1.1 * k), 0.05 * k},
                     fromRotationVector(Vec3d{0.3 * std::sin(0.7 * k), 0.1 * k, 0})});
  const Motion motion = along(poses);
  std::vector<Vec3f> at24;
  for (const double fps : {24.0, 48.0, 96.0}) {
    std::vector<Vec3f> last;
    run(motion, fps, 2, [&](const std::vector<Vec3f>& positions, const HeadPose&) { last = positions; });
    ASSERT_FALSE(last.empty());
    if (at24.empty()) at24 = last;
    float apart = 0;
    for (std::size_t i = 0; i < last.size(); ++i) apart = std::max(apart, length(last[i] - at24[i]));
    fmt::print("{} frames a second: {:.1e} of the length from 24\n", fps, apart / kLength);
    EXPECT_LE(apart, 1e-6 * kLength);  // the steps are the same instants
  }
}

// The tip, seen from the head, and how far it is from the middle of where it was a step before and will be a
// step after: of a smooth path that is its acceleration, a^2 / 2 of a step.
TEST_F(KeyframeMotion, SteadyMotionGivesNoJitter) {
  std::vector<HeadPose> poses;
  for (int k = 0; k <= 24 * 8; ++k)
    poses.push_back({{0.05 * k, 0, -0.02 * k}, fromRotationVector(Vec3d{0, 2.0 / 24 * k, 0})});
  std::vector<Vec3d> tips;
  run(along(poses), kStepsPerSecond, 8, [&](const std::vector<Vec3f>& positions, const HeadPose& head) {
    tips.push_back(rotate(head.rotation.conjugate(), static_cast<Vec3d>(positions.back())));
  });
  ASSERT_EQ(tips.size(), 8 * kStepsPerSecond);
  double jitter = 0, moved = 0;
  for (std::size_t k = tips.size() - 2 * 192; k + 1 < tips.size(); ++k) {
    jitter = std::max(jitter, length(tips[k] - (tips[k - 1] + tips[k + 1]) * 0.5));
    moved = std::max(moved, length(tips[k] - tips.back()));
  }
  fmt::print("last 2 s: jitter {:.1e} of the length, moved {:.1e}\n", jitter / kLength, moved / kLength);
  EXPECT_LE(jitter, 1e-7 * kLength);
}

}  // namespace
}  // namespace ringlet::test::keyframe_motion_test
