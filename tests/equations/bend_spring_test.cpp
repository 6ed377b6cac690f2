// Tests reference/equations/bend_spring.h.
#include "reference/equations/bend_spring.h"

#include <gtest/gtest.h>

#include "tests/equations/strand_fixtures.h"

namespace ringlet::reference::test::bend_spring_test {
namespace {

// With the target held: minus the slope of k/2 |p1 - p0 - t|^2 at p0.
TEST(BendSpring, IsTheGradientOfItsEnergyWithTheTargetHeld) {
  std::mt19937 random(1);
  const double k = 1.5, h = 1e-6;
  for (int trial = 0; trial < 50; ++trial) {
    const Vector3<double> edge = randomVector(random, 1), target = randomVector(random, 1);
    const Vector3<double> force = bendForce(k, edge, target);
    const auto energy = [&](const Vector3<double>& shift) {
      return k / 2 * (edge - shift - target).squaredNorm();
    };
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3<double> step = h * Vector3<double>::Unit(axis);
      EXPECT_NEAR(force[axis], -(energy(step) - energy(-step)) / (2 * h), 1e-8);
    }
  }
}

TEST(BendSpring, IsZeroOnItsTarget) {
  const Vector3<double> edge(0.1, -0.2, 0.3);
  EXPECT_EQ(bendForce(7.0, edge, edge).norm(), 0.0);
}

TEST(BendSpring, DampsAcrossTheEdgeOnly) {
  const Vector3<double> direction(0.6, 0.8, 0), across(-0.8, 0.6, 2);
  EXPECT_LT(bendDamping(5.0, Vector3<double>(3 * direction), direction).norm(), 1e-14);
  EXPECT_LT((bendDamping(5.0, across, direction) - 5 * across).norm(), 1e-14);
}

// The step adds T k by itself: taken off, but at least half of c stays.
TEST(BendSpring, DampingIsCompensatedForTheStep) {
  EXPECT_DOUBLE_EQ(compensatedBendDamping(1.0, 40.0, 0.005), 0.8);
  EXPECT_DOUBLE_EQ(compensatedBendDamping(1.0, 400.0, 0.005), 0.5);
}

}  // namespace
}  // namespace ringlet::reference::test::bend_spring_test
