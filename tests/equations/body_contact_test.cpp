// Tests reference/equations/body_contact.h: ways into bodies, however fast, and friction.
#include "reference/equations/body_contact.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/equations/strand_fixtures.h"
#include "tests/support/sample_bodies.h"

namespace ringlet::reference::test::body_contact_test {
namespace {

using ringlet::test::gridBall;
using ringlet::test::sampleBodies;

using Vector = Vector3<double>;

// Where a way touches is on the surface, on the way, and nothing before it is inside.
TEST(BodyContact, AWayIsFollowedToItsFirstTouch) {
  std::mt19937 random(1);
  for (const Body& body : sampleBodies()) {
    int touched = 0;
    for (int k = 0; k < 500; ++k) {
      const Vector y0 = randomVector(random, 0.4), y1 = randomVector(random, 0.4);
      if (bodyDistance(body, y0).distance < 0) continue;
      const Touch<double> touch = traceParticle(body, y0, y1);
      double deepest = 1;  // of a fine look along the way
      for (int i = 0; i <= 1000; ++i)
        deepest = std::min(deepest, bodyDistance<double>(body, y0 + 0.001 * i * (y1 - y0)).distance);
      if (deepest < -1e-3) {
        EXPECT_TRUE(touch.found) << body.name;
      }
      if (!touch.found) continue;
      ++touched;
      const double share = (touch.place - y0).norm() / (y1 - y0).norm();
      EXPECT_LE(share, 1);
      for (int i = 0; i < 100; ++i) {
        const Vector before = y0 + 0.0099 * i * (touch.place - y0);
        EXPECT_GT(bodyDistance<double>(body, before).distance, body.shape == BodyShape::grid ? -5e-4 : -1e-5)
            << body.name;
      }
    }
    EXPECT_GT(touched, 10) << body.name;
  }
}

// A metre in one step through a ball of 1 cm: nothing passes, from whatever side.
TEST(BodyContact, NothingTunnels) {
  std::mt19937 random(2);
  for (const Body& body : {Body{.shape = BodyShape::sphere, .radius = 0.01}, gridBall(0.01, 0.001)}) {
    for (int k = 0; k < 500; ++k) {
      const Vector direction = randomVector(random, 1).normalized();
      const Vector offset = 0.008 * direction.cross(randomVector(random, 1)).normalized();
      const Touch<double> touch =
          traceParticle<double>(body, -0.5 * direction + offset, 0.5 * direction + offset);
      ASSERT_TRUE(touch.found);
      EXPECT_LT(bodyDistance(body, touch.place).distance, 1e-4);
      EXPECT_LT(touch.place.dot(direction), 0);
    }
  }
}

TEST(BodyContact, AnEdgeTouchesBetweenItsEnds) {
  // 8 cm long, 0.5 m in a step, past a thin rod that neither end meets.
  const Body rod{.shape = BodyShape::capsule, .radius = 0.005, .length = 1};
  const Touch<double> touch =
      traceEdge<double>(rod, {-0.3, 0, -0.05}, {0.2, 0, -0.05}, {-0.3, 0, 0.03}, {0.2, 0, 0.03});
  ASSERT_TRUE(touch.found);
  EXPECT_NEAR(touch.along, 0.625, 0.02);
  EXPECT_NEAR(touch.place.x(), -0.005, 2e-4);
  EXPECT_NEAR(touch.surface.normal.x(), -1, 1e-2);
  // What passes beside it does not.
  EXPECT_FALSE(
      (traceEdge<double>(rod, {-0.3, 0, 0.01}, {0.2, 0, 0.01}, {-0.3, 0, 0.09}, {0.2, 0, 0.09}).found));
}

// By the closed form of a segment and a point: the deepest place of an edge near a ball.
TEST(BodyContact, TheDeepestPlaceOfAnEdgeAtABall) {
  const Body ball{.shape = BodyShape::sphere, .radius = 0.1};
  std::mt19937 random(4);
  for (int k = 0; k < 300; ++k) {
    const Vector middle = 0.1 * randomVector(random, 1).normalized();
    const Vector along = 0.02 * middle.cross(randomVector(random, 1)).normalized();
    const double shift = std::uniform_real_distribution<double>(-0.8, 0.8)(random);
    const Vector a = middle + (shift - 1) * along, b = middle + (shift + 1) * along;
    const EdgeSurface<double> deepest = edgeDistance(ball, a, b);
    ASSERT_TRUE(deepest.isWithin);
    EXPECT_LT((deepest.place - middle).norm(), 2e-4);
    EXPECT_NEAR(deepest.surface.distance, 0, 1e-6);
  }
}

TEST(BodyContact, LeavesNoFasterThanAllowed) {
  const Body ball{.shape = BodyShape::sphere, .radius = 0.1};
  const Vector inside(0.02, 0, 0), shallow(0.0999, 0, 0);
  EXPECT_EQ(leastParting(traceParticle(ball, inside, inside), 0.005), kLeaveSpeed);
  EXPECT_NEAR(leastParting(traceParticle(ball, shallow, shallow), 0.005), 0.02, 1e-9);
  // From outside it may near the surface as far as it is.
  const Vector outside(0.2, 0, 0);
  EXPECT_NEAR(leastParting(traceParticle<double>(ball, outside, Vector::Zero()), 0.005), -0.1 / 0.005, 1e-6);
}

// One particle of 1 kg that slides at u: what weight and rest take together is Coulomb's, or all it has.
TEST(BodyContact, FrictionTakesAShareAndStops) {
  const Vector sliding(2, 0, 0);
  for (const double pressed : {0.0, 0.5, 2.0, 4.9, 5.1, 20.0, 1e4}) {
    const double weight = frictionWeight<double>(sliding, pressed, 0.4, 1);
    const Vector solved = sliding / (1 + weight);
    const Vector left = rubbed<double>(solved, solved, weight, pressed, 0.4, 1);
    // Sliding on, it has lost less than Coulomb's, and in the limit of little friction all of that.
    if (0.4 * pressed < 2) {
      EXPECT_GE(2 - left.x(), 0.4 * pressed * 2 / (2 + 0.4 * pressed) - 1e-12) << pressed;
      EXPECT_LE(2 - left.x(), 0.4 * pressed + 1e-12) << pressed;
      EXPECT_GT(left.x(), 0) << pressed;
    } else {
      EXPECT_NEAR(left.x(), 0, 1e-12) << pressed;
    }
  }
  EXPECT_EQ((rubbed<double>(sliding, sliding, 0, -1, 0.4, 1)), sliding);
}

}  // namespace
}  // namespace ringlet::reference::test::body_contact_test
