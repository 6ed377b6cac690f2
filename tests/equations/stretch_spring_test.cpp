// Tests reference/equations/stretch_spring.h.
#include "reference/equations/stretch_spring.h"

#include <gtest/gtest.h>

#include "tests/equations/strand_fixtures.h"

namespace ringlet::reference::test::stretch_spring_test {
namespace {

TEST(StretchSpring, PullsItsEndsTogetherWhenLong) {
  const Vector3<double> edge(0, 0, -0.006), direction(0, 0, -1);
  // 2 mm too long at 3 N/m: 6 mN on particle i, towards i + 1.
  EXPECT_LT((stretchForce(3.0, edge, direction, 0.004) - Vector3<double>(0, 0, -0.006)).norm(), 1e-17);
  EXPECT_EQ(stretchForce(3.0, edge, direction, 0.006).norm(), 0.0);
  EXPECT_GT(stretchForce(3.0, edge, direction, 0.008).z(), 0);
}

// Force on particle i is minus the energy's slope there; energy k/2 (|p1 - p0| - s)^2. On i + 1 its negative.
TEST(StretchSpring, IsTheGradientOfItsEnergy) {
  std::mt19937 random(1);
  const double k = 2.5, rest = 0.7, h = 1e-6;
  for (int trial = 0; trial < 50; ++trial) {
    const Field<double> p = randomField(random, 2, 1);
    const auto energy = [&](const Vector3<double>& p0, const Vector3<double>& p1) {
      return k / 2 * ((p1 - p0).norm() - rest) * ((p1 - p0).norm() - rest);
    };
    const Vector3<double> edge = p[1] - p[0], force = stretchForce(k, edge, directionOr(edge, edge), rest);
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3<double> step = h * Vector3<double>::Unit(axis);
      const double slope0 = (energy(p[0] + step, p[1]) - energy(p[0] - step, p[1])) / (2 * h);
      const double slope1 = (energy(p[0], p[1] + step) - energy(p[0], p[1] - step)) / (2 * h);
      EXPECT_NEAR(force[axis], -slope0, 1e-8);
      EXPECT_NEAR(-force[axis], -slope1, 1e-8);
    }
  }
}

TEST(StretchSpring, DampsTheRateAlongTheEdgeOnly) {
  const Vector3<double> direction(0.6, 0.8, 0);
  EXPECT_LT(stretchDamping(5.0, Vector3<double>(-0.8, 0.6, 2), direction).norm(), 1e-15);
  EXPECT_LT((stretchDamping(5.0, Vector3<double>(1.2, 1.6, 0), direction) - 10 * direction).norm(), 1e-14);
}

}  // namespace
}  // namespace ringlet::reference::test::stretch_spring_test
