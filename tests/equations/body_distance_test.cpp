// Tests reference/equations/body_distance.h: closed forms, directions by finite differences, grids.
#include "reference/equations/body_distance.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/equations/strand_fixtures.h"
#include "tests/support/sample_bodies.h"

namespace ringlet::reference::test::body_distance_test {
namespace {

using ringlet::test::gridBall;
using ringlet::test::sampleBodies;

using Vector = Vector3<double>;

double distanceAt(const Body& body, const Vector& y) { return bodyDistance<double>(body, y).distance; }

TEST(BodyDistance, Sphere) {
  const Body ball{.shape = BodyShape::sphere, .radius = 0.1, .thickness = 0.01};
  EXPECT_NEAR(distanceAt(ball, {0.3, 0, 0}), 0.19, 1e-15);
  EXPECT_NEAR(distanceAt(ball, {0, -0.05, 0}), -0.06, 1e-15);
  EXPECT_NEAR(distanceAt(ball, {0.06, 0.08, 0}), -0.01, 1e-15);
  EXPECT_EQ(bodyDistance<double>(ball, Vector(0, 0, -2)).normal, Vector(0, 0, -1));
}

TEST(BodyDistance, CapsuleIsASphereBeyondItsEndsAndACylinderBetween) {
  const Body capsule{.shape = BodyShape::capsule, .radius = 0.1, .length = 0.4};
  EXPECT_NEAR(distanceAt(capsule, {0.3, 0.1, 0}), 0.2, 1e-15);
  EXPECT_NEAR(distanceAt(capsule, {0, 0.5, 0}), 0.2, 1e-15);
  EXPECT_NEAR(distanceAt(capsule, {0.3, -0.6, 0}), 0.4, 1e-15);  // 0.3, 0.4, 0.5
  EXPECT_NEAR(distanceAt(capsule, {0.02, 0.19, 0}), -0.08, 1e-15);
}

TEST(BodyDistance, BoxByFacesEdgesAndCorners) {
  const Body box{.shape = BodyShape::box, .halfExtents = {1, 2, 3}};
  EXPECT_NEAR(distanceAt(box, {1.5, 0, 0}), 0.5, 1e-15);
  EXPECT_NEAR(distanceAt(box, {1.3, 2.4, 0}), 0.5, 1e-15);
  EXPECT_NEAR(distanceAt(box, {-3, -4, 4}), 3, 1e-15);
  EXPECT_NEAR(distanceAt(box, {0.8, 1, 1}), -0.2, 1e-15);
  EXPECT_EQ(bodyDistance<double>(box, Vector(0, -1.9, 0)).normal, Vector(0, -1, 0));
}

TEST(BodyDistance, PlaneIsSolidBelow) {
  const Body plane{.shape = BodyShape::plane, .thickness = 0.5};
  EXPECT_NEAR(distanceAt(plane, {7, 3, -4}), 2.5, 1e-15);
  EXPECT_NEAR(distanceAt(plane, {7, -3, -4}), -3.5, 1e-15);
}

// The way out is the distance's gradient, of length 1, wherever that is smooth.
TEST(BodyDistance, NormalIsTheGradient) {
  std::mt19937 random(3);
  for (const Body& body : sampleBodies()) {
    for (int k = 0; k < 200; ++k) {
      const Vector y = randomVector(random, 0.3);
      const Surface<double> surface = bodyDistance<double>(body, y);
      EXPECT_NEAR(surface.normal.norm(), 1, 1e-12) << body.name;
      if (body.shape == BodyShape::grid) continue;  // below
      Vector gradient;
      for (int axis = 0; axis < 3; ++axis) {
        const Vector h = 1e-6 * Vector::Unit(axis);
        gradient[axis] = (distanceAt(body, y + h) - distanceAt(body, y - h)) / 2e-6;
      }
      EXPECT_LT((gradient - surface.normal).norm(), 1e-4) << body.name << " at " << y.transpose();
    }
  }
}

// A grid of a sphere: half a cell right everywhere, direction within a few degrees; and beyond the grid never
// further than the surface is.
TEST(BodyDistance, GridFollowsWhatItSampled) {
  const Body body = gridBall(0.1, 0.01);
  std::mt19937 random(5);
  double worst = 0, worstTurn = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vector y = randomVector(random, 0.25);
    const Surface<double> surface = bodyDistance<double>(body, y);
    const double exact = y.norm() - 0.1;
    const bool isWithin = y.cwiseAbs().maxCoeff() < 0.15;
    if (isWithin && y.norm() > 0.03) {
      worst = std::max(worst, std::abs(surface.distance - exact));
      worstTurn = std::max(worstTurn, (surface.normal - y.normalized()).norm());
    }
    if (!isWithin) {
      EXPECT_LE(surface.distance, exact + 1e-3 * exact) << y.transpose();
      EXPECT_GT(surface.distance, 0.6 * exact) << y.transpose();
    }
  }
  EXPECT_LT(worst, 0.005);
  EXPECT_LT(worstTurn, 0.2);
  RecordProperty("worst_in_cells", std::to_string(worst / 0.01));
}

// The interpolant's own gradient, within a cell.
TEST(BodyDistance, GridNormalIsTheInterpolantsGradient) {
  const Body body = gridBall(0.1, 0.01);
  std::mt19937 random(6);
  for (int k = 0; k < 200; ++k) {
    Vector y = randomVector(random, 0.14);
    for (int axis = 0; axis < 3; ++axis)  // away from where cells meet
      y[axis] =
          0.01 * (std::floor(y[axis] / 0.01) + 0.1 + 0.8 * (y[axis] / 0.01 - std::floor(y[axis] / 0.01)));
    Vector gradient;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector h = 1e-6 * Vector::Unit(axis);
      gradient[axis] = distanceAt(body, y + h) - distanceAt(body, y - h);
    }
    EXPECT_LT((gradient.normalized() - bodyDistance<double>(body, y).normal).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace ringlet::reference::test::body_distance_test
