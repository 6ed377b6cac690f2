// Tests reference/equations/frame.h: the smallest rotation, and parallel transport against closed forms.
#include "reference/equations/frame.h"

#include <gtest/gtest.h>

#include "tests/equations/strand_fixtures.h"

namespace ringlet::reference::test::frame_test {
namespace {

constexpr double kRounding = 1e-14;

Rotation<double> identity() { return Rotation<double>::Identity(); }

TEST(SmallestRotation, TakesADirectionToTheOtherAboutTheirNormal) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3<double> a = randomVector(random, 1), b = randomVector(random, 10);
    const Rotation<double> turn = smallestRotation(a, b);
    EXPECT_NEAR(turn.norm(), 1, kRounding);
    EXPECT_LT((turn * a.normalized() - b.normalized()).norm(), 10 * kRounding);
    // Smallest: its axis is across both, its angle the one between them.
    EXPECT_NEAR(turn.vec().dot(a.normalized()), 0, kRounding);
    EXPECT_NEAR(2 * std::atan2(turn.vec().norm(), turn.w()), std::acos(a.normalized().dot(b.normalized())),
                1e-7);
  }
}

TEST(SmallestRotation, OppositeDirectionsAreSafe) {
  for (const Vector3<double>& a :
       {Vector3<double>(1, 0, 0), Vector3<double>(0, -2, 0), Vector3<double>(0.3, 0.4, -0.5)}) {
    // Exactly opposite, and less and less so; a millionth of a radian may be taken for a half turn.
    for (const double off : {0.0, 1e-9, 1e-5, 1e-3}) {
      const Vector3<double> b = -a + off * a.norm() * a.unitOrthogonal();
      const Rotation<double> turn = smallestRotation(a, b);
      EXPECT_NEAR(turn.norm(), 1, kRounding);
      EXPECT_LT((turn * a.normalized() - b.normalized()).norm(), 1.1e-6) << off;
    }
    const Vector3<float> single = a.cast<float>(), opposite = -single;
    EXPECT_LT((smallestRotation(single, opposite) * single.normalized() + single.normalized()).norm(), 1e-6f);
  }
}

TEST(SmallestRotation, ZeroVectorsTurnNothing) {
  const Vector3<double> zero = Vector3<double>::Zero(), x = Vector3<double>::UnitX();
  EXPECT_EQ(smallestRotation(zero, x).coeffs(), identity().coeffs());
  EXPECT_EQ(smallestRotation(x, zero).coeffs(), identity().coeffs());
}

TEST(TransportFrames, FollowsDirectionsWithoutTwist) {
  std::mt19937 random(2);
  // Small and large turns; directions are carried: F_i takes the root's x to d_i.
  for (const double bend : {0.05, 1.0}) {
    Field<double> d{Vector3<double>(1, 0, 0)};
    for (int i = 0; i < 100; ++i) d.push_back((d.back() + randomVector(random, bend)).normalized());
    std::vector<Rotation<double>> frames;
    transportFrames(identity(), d[0], d, frames);
    for (std::size_t i = 1; i < d.size(); ++i) {
      EXPECT_LT((frames[i] * d[0] - d[i]).norm(), 1e-12);
      // The turn from edge to edge as an angular velocity: nothing of it lies along the tangent.
      const Rotation<double> turn = frames[i] * frames[i - 1].conjugate();
      EXPECT_NEAR(turn.vec().dot(d[i]), 0, 1e-13);
      EXPECT_NEAR(turn.vec().dot(d[i - 1]), 0, 1e-13);
    }
  }
}

TEST(TransportFrames, OnAPlanarCurveIsTheTurnAboutThePlanesNormal) {
  Field<double> d;
  for (int i = 0; i < 60; ++i) d.push_back({std::cos(0.3 * i), std::sin(0.3 * i), 0});
  std::vector<Rotation<double>> frames;
  transportFrames(identity(), d[0], d, frames);
  for (std::size_t i = 0; i < d.size(); ++i) {
    const Rotation<double> expected(
        Eigen::AngleAxisd(0.3 * static_cast<double>(i), Vector3<double>::UnitZ()));
    EXPECT_LT(frames[i].angularDistance(expected), 1e-7);
  }
}

// Directions that go once round a cone of half angle theta in n steps walk a regular n-gon on the sphere.
// Parallel transport turns the frame by the polygon's area (Gauss-Bonnet): 2 n B - (n - 2) pi, with B the
// base angle of its n isosceles triangles, tan B = 1 / (cos theta tan(pi / n)).
TEST(TransportFrames, OnAHelixTurnsByTheSolidAngle) {
  for (const int n : {5, 12, 40}) {
    const double theta = 0.7;
    Field<double> d;
    for (int i = 0; i <= n; ++i) {
      const double angle = 2 * kPi * i / n;
      d.push_back({std::sin(theta) * std::cos(angle), std::sin(theta) * std::sin(angle), std::cos(theta)});
    }
    std::vector<Rotation<double>> frames;
    transportFrames(identity(), d[0], d, frames);
    const double base = std::atan(1 / (std::cos(theta) * std::tan(kPi / n)));
    const double area = 2 * n * base - (n - 2) * kPi;
    const Rotation<double> expected(Eigen::AngleAxisd(area, d[0]));
    EXPECT_LT(frames.back().angularDistance(expected), 1e-7) << n;
  }
}

TEST(TransportFrames, TurnsWithTheRoot) {
  std::mt19937 random(3);
  const Field<double> d = randomField(random, 40, 1);
  const Rotation<double> turn = randomRotation(random);
  Field<double> turned;
  for (const Vector3<double>& direction : d) turned.push_back(turn * direction);
  std::vector<Rotation<double>> frames, turnedFrames;
  const Vector3<double> x = randomVector(random, 1), turnedX = turn * x;
  transportFrames(identity(), x, d, frames);
  transportFrames(turn, turnedX, turned, turnedFrames);
  for (std::size_t i = 0; i < d.size(); ++i) {
    EXPECT_LT((turnedFrames[i].toRotationMatrix() - (turn * frames[i]).toRotationMatrix()).norm(), 1e-11);
  }
}

TEST(TransportFrames, AZeroEdgeIsSteppedOver) {
  const Field<double> d{{1, 0, 0}, {0, 0, 0}, {0, 1, 0}};
  std::vector<Rotation<double>> frames;
  transportFrames(identity(), d[0], d, frames);
  EXPECT_LT(frames[1].angularDistance(frames[0]), kRounding);
  EXPECT_LT((frames[2] * d[0] - d[2]).norm(), kRounding);
}

}  // namespace
}  // namespace ringlet::reference::test::frame_test
