// scene/keyframes.h.
#include "ringlet/scene/keyframes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ringlet::test::keyframes_test {
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

  // With times of their own, a smaller turn in less time is the faster.
  keys = {};
  keys.times = {0, 1, 3, 3.1};
  for (double angle : {0.0, 1.0, 3.0, 3.5})
    keys.poses.push_back({{}, fromRotationVector(Vec3d{0, angle, 0})});
  EXPECT_NEAR(keys.fastestTurn().speed, 5, 1e-9);
  EXPECT_EQ(keys.fastestTurn().key, 2u);
}

// An artist's few keys: they are met at their times, stayed at before the first and after the last, and
// passed without a jolt.
Keyframes artists() {
  Keyframes keys;
  keys.times = {0.5, 0.6, 1.5, 1.75, 4};
  keys.restsAtEnds = true;
  for (std::size_t k = 0; k < keys.times.size(); ++k) {
    const auto x = static_cast<double>(k);
    Quatd turn = fromRotationVector(Vec3d{0.5 * x, -0.4 * x * x, 0.2});
    if (k % 2 == 1) turn = {-turn.x, -turn.y, -turn.z, -turn.w};  // the same rotation
    keys.poses.push_back({{std::sin(x), 0.3 * x, -x}, turn});
  }
  return keys;
}

double apart(const HeadPose& a, const HeadPose& b) {
  return length(a.position - b.position) +
         length(rotate(a.rotation, Vec3d{1, 2, 3}) - rotate(b.rotation, Vec3d{1, 2, 3}));
}

TEST(Keyframes, OfTheirOwnTimesAreMetAndPassedWithoutAJolt) {
  const Keyframes keys = artists();
  EXPECT_EQ(keys.seconds(), 4);
  for (std::size_t k = 0; k < keys.times.size(); ++k)
    EXPECT_LT(apart(keys.poseAt(keys.times[k]), keys.poses[k]), 1e-12) << k;
  EXPECT_EQ(apart(keys.poseAt(-3), keys.poses.front()), 0);
  EXPECT_EQ(apart(keys.poseAt(0.4), keys.poses.front()), 0);
  EXPECT_EQ(apart(keys.poseAt(100), keys.poses.back()), 0);
  const double h = 1e-6;
  for (double t : keys.times) {
    const Vec3d before = (keys.poseAt(t).position - keys.poseAt(t - h).position) / h;
    const Vec3d after = (keys.poseAt(t + h).position - keys.poseAt(t).position) / h;
    EXPECT_LT(length(after - before), 1e-3) << t;
    const auto seen = [&](double at) { return rotate(keys.poseAt(at).rotation, Vec3d{1, 2, 3}); };
    EXPECT_LT(length((seen(t + h) - seen(t)) - (seen(t) - seen(t - h))) / h, 1e-3) << t;
  }
}

TEST(Keyframes, OfTheirOwnTimesMayBeLinear) {
  Keyframes keys = artists();
  keys.interpolation = Keyframes::Interpolation::linear;
  const HeadPose middle = keys.poseAt(1.05);
  EXPECT_LT(length(middle.position - (keys.poses[1].position + keys.poses[2].position) * 0.5), 1e-12);
  EXPECT_LT(apart({{}, middle.rotation}, {{}, slerp(keys.poses[1].rotation, keys.poses[2].rotation, 0.5)}),
            1e-12);
}

// Equal times, given one by one, are equal times: positions on the same cubic.
TEST(Keyframes, OfEqualTimesGoTheSameWay) {
  Keyframes equal{0.1, {}};
  for (int k = 0; k < 12; ++k)
    equal.poses.push_back(
        {{std::sin(0.9 * k), 0, std::cos(2.0 * k)}, fromRotationVector(Vec3d{0.1 * k, 0, 0})});
  Keyframes own = equal;
  for (std::size_t k = 0; k < own.poses.size(); ++k) own.times.push_back(equal.timeOf(k));
  for (double t = -1; t < 1.5; t += 0.0137) {
    EXPECT_LT(length(own.poseAt(t).position - equal.poseAt(t).position), 1e-12) << t;
    EXPECT_LT(apart(own.poseAt(t), equal.poseAt(t)), 1.25e-4)
        << "the cube of half the turn from key to key: " << t;
  }
  EXPECT_NEAR(own.fastestTurn().speed, 1, 1e-9);
}

// The speed at a key is that of the parabola through it and its neighbours. So keys on a parabola are joined
// by that parabola, however uneven their times are, and keys of a steady turn by the steady turn.
TEST(Keyframes, OfTheirOwnTimesFollowAParabola) {
  Keyframes keys;
  keys.times = {0, 0.1, 1, 1.05, 1.3, 3, 3.2};
  const auto at = [](double t) { return Vec3d{2 * t * t - 3 * t + 1, -0.5 * t * t, 4 - t}; };
  for (double t : keys.times) keys.poses.push_back({at(t), fromRotationVector(Vec3d{0, 0.1 * t, 0})});
  // The first and the last stretch end at a key that has one neighbour only.
  for (std::size_t k = 1; k + 2 < keys.times.size(); ++k) {
    for (double share = 0; share <= 1; share += 0.125) {
      const double t = keys.times[k] + share * (keys.times[k + 1] - keys.times[k]);
      EXPECT_LT(length(keys.poseAt(t).position - at(t)), 1e-12) << t;
      EXPECT_LT(length(rotate(keys.poseAt(t).rotation, Vec3d{1, 0, 0}) -
                       Vec3d{std::cos(0.1 * t), 0, -std::sin(0.1 * t)}),
                1e-4)
          << t;
    }
  }
}

// Where the file rests at its ends, the steady motion of a head that comes gliding does not.
TEST(Keyframes, OfTheirOwnTimesMayComeGliding) {
  Keyframes keys = turning(3, 0.1, 8);
  for (std::size_t k = 0; k < keys.poses.size(); ++k) keys.times.push_back(0.1 * static_cast<double>(k) + 2);
  for (double t = 1.9; t < 2.7; t += 0.0037)
    EXPECT_LT(apart(keys.poseAt(t), turning(3, 0.1, 8).poseAt(t - 2)), 1e-3) << t;
}

}  // namespace
}  // namespace ringlet::test::keyframes_test
