// scene/keyframes.h.
#include "ringlet/scene/keyframes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ringlet::test {
namespace {

Keyframes turning(double speed, double secondsPerKey, int count) {
  Keyframes keys{secondsPerKey, {}};
  for (int k = 0; k < count; ++k) {
    const double t = k * secondsPerKey;
    keys.poses.push_back({{0.3 * t, -0.1 * t, 2 * t}, fromRotationVector(Vec3d{0, speed * t, 0})});
  }
  return keys;
}

TEST(Keyframes, PassThroughEveryKey) {
  Keyframes keys{0.05, {}};
  for (int k = 0; k < 20; ++k)
    keys.poses.push_back(
        {{std::sin(0.7 * k), std::cos(1.3 * k), 0.1 * k * k}, fromRotationVector(Vec3d{0.1 * k, 0.3, 0})});
  for (int k = 0; k < 20; ++k) {
    const HeadPose pose = keys.poseAt(0.05 * k);
    EXPECT_LT(length(pose.position - keys.poses[static_cast<std::size_t>(k)].position), 1e-12) << k;
    EXPECT_LT(length(rotate(pose.rotation, Vec3d{1, 2, 3}) -
                     rotate(keys.poses[static_cast<std::size_t>(k)].rotation, Vec3d{1, 2, 3})),
              1e-12);
  }
}

// A constant velocity and a constant spin have no jitter, before the first key as well as between any two;
// long before, the head does not turn.
TEST(Keyframes, SteadyMotionIsSteady) {
  const Keyframes keys = turning(3, 1.0 / 24, 48);
  for (double t = -0.5; t < keys.seconds(); t += 0.0037) {
    const HeadPose pose = keys.poseAt(t);
    EXPECT_LT(length(pose.position - Vec3d{0.3 * t, -0.1 * t, 2 * t}), 1e-12) << t;
    if (t < -0.1) continue;
    EXPECT_LT(length(rotate(pose.rotation, Vec3d{1, 0, 0}) - Vec3d{std::cos(3 * t), 0, -std::sin(3 * t)}),
              1e-12)
        << t;
  }
  EXPECT_NEAR(keys.fastestTurn().speed, 3, 1e-9);
  EXPECT_LT(length(rotate(keys.poseAt(-5).rotation, Vec3d{1, 0, 0}) -
                   rotate(keys.poseAt(-4).rotation, Vec3d{1, 0, 0})),
            1e-8);
  const Vec3d turned = rotate(keys.poseAt(-5).rotation, Vec3d{1, 0, 0});
  EXPECT_NEAR(std::atan2(turned.z, turned.x), 3 * 0.3, 1e-6) << "as far as in 0.3 s at full speed";
}

TEST(Keyframes, VelocityIsContinuous) {
  Keyframes keys{0.1, {}};
  for (int k = 0; k < 12; ++k) keys.poses.push_back({{std::sin(0.9 * k), 0, std::cos(2.0 * k)}, {}});
  const double h = 1e-6;
  for (int k = 0; k < 11; ++k) {
    const double t = 0.1 * k;
    const Vec3d before = (keys.poseAt(t).position - keys.poseAt(t - h).position) / h;
    const Vec3d after = (keys.poseAt(t + h).position - keys.poseAt(t).position) / h;
    EXPECT_LT(length(after - before), 1e-3) << k;
  }
}

TEST(Keyframes, StayAtTheLast) {
  const Keyframes keys = turning(1, 0.1, 5);
  for (double t : {0.4, 0.41, 100.0, HUGE_VAL})
    EXPECT_EQ(keys.poseAt(t).position, keys.poses.back().position) << t;
  EXPECT_EQ((Keyframes{0.1, {HeadPose{{1, 2, 3}, {}}}}.poseAt(-3).position), (Vec3d{1, 2, 3}));
}

TEST(Keyframes, FindTheFastestTurn) {
  Keyframes keys = turning(0, 0.01, 10);
  keys.poses[7].rotation = keys.poses[8].rotation = keys.poses[9].rotation =
      fromRotationVector(Vec3d{0, 0, std::numbers::pi / 2});
  EXPECT_NEAR(keys.fastestTurn().speed, 50 * std::numbers::pi, 1e-9);
  EXPECT_EQ(keys.fastestTurn().key, 6u);
}

}  // namespace
}  // namespace ringlet::test
