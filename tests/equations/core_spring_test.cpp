// Tests reference/equations/core_spring.h, and the core's forces as a whole: transposed, they are a gradient.
#include "reference/equations/core_spring.h"

#include <gtest/gtest.h>

#include "reference/equations/smoothing.h"
#include "tests/equations/strand_fixtures.h"

namespace ringlet::reference::test::core_spring_test {
namespace {

TEST(CoreSpring, OpposesElongationAndItsRate) {
  const Vector3<double> b(0, 0.3, 0.4);
  const Vector3<double> pull = coreForce(10.0, b, 0.4);  // 0.1 m too long: on particle i, towards i + 1
  EXPECT_LT((pull - Vector3<double>(0, 0.6, 0.8)).norm(), 1e-14);
  EXPECT_LT((coreForce(10.0, b, 0.6) + Vector3<double>(0, 0.6, 0.8)).norm(), 1e-14);
  EXPECT_LT((coreDamping(2.0, b, b) - 2 * b).norm(), 1e-15);
  EXPECT_LT(coreDamping(2.0, Vector3<double>(1, 0.4, -0.3), b).norm(), 1e-15);
}

TEST(CoreSpring, AZeroEdgeHasNoForce) {
  const Vector3<double> zero = Vector3<double>::Zero(), v(1, 2, 3);
  EXPECT_EQ(coreForce(10.0, zero, 0.4).norm(), 0.0);
  EXPECT_EQ(coreDamping(10.0, v, zero).norm(), 0.0);
}

TEST(CoreSpring, ElongationIsTheSumOfLengthsOverTheirRest) {
  EXPECT_DOUBLE_EQ(coreElongation(Field<double>{{3, 4, 0}, {0, 0, 1}}, 4.0), 1.5);
  EXPECT_DOUBLE_EQ(coreElongation(Field<double>{{3, 4, 0}}, 0.0), 1.0);
}

TEST(CoreSpring, BlendsBetweenItsLimits) {
  EXPECT_DOUBLE_EQ(coreScale(0.9, 1.0, 1.1, 0.25), 0.25);
  EXPECT_DOUBLE_EQ(coreScale(1.0, 1.0, 1.1, 0.25), 0.25);
  EXPECT_NEAR(coreScale(1.05, 1.0, 1.1, 0.25), 0.625, 1e-14);                   // smoothstep(1/2) = 1/2
  EXPECT_NEAR(coreScale(1.025, 1.0, 1.1, 0.25), 0.25 + 0.75 * 0.15625, 1e-13);  // smoothstep(1/4) = 5/32
  EXPECT_DOUBLE_EQ(coreScale(1.1, 1.0, 1.1, 0.25), 1.0);
  EXPECT_DOUBLE_EQ(coreScale(2.0, 1.0, 1.1, 0.25), 1.0);
  // Limits that coincide: a step.
  EXPECT_DOUBLE_EQ(coreScale(0.99, 1.0, 1.0, 0.25), 0.25);
  EXPECT_DOUBLE_EQ(coreScale(1.0, 1.0, 1.0, 0.25), 1.0);
}

// Energy sum k/2 (|b_i| - rest_i)^2 of the smoothed edges; through the transpose the forces on the particles
// are minus its slope. The start of the filter is held: it belongs to the head.
TEST(CoreSpring, TransposedIsTheGradientOfItsEnergy) {
  std::mt19937 random(1);
  const double k = 3, beta = 0.35, h = 1e-6;
  Field<double> p = randomField(random, 12, 1);
  const Vector3<double> start = randomVector(random, 1);
  const double rest = 0.3;
  Field<double> edges, b;
  const auto energy = [&] {
    differences(p, edges);
    smooth(edges, beta, start, b);
    double sum = 0;
    for (const Vector3<double>& bi : b) sum += k / 2 * (bi.norm() - rest) * (bi.norm() - rest);
    return sum;
  };
  energy();
  Field<double> forces, spread;
  for (const Vector3<double>& bi : b) forces.push_back(coreForce(k, bi, rest));
  smoothTransposed(forces, beta, spread);

  for (std::size_t i = 0; i < p.size(); ++i) {
    Vector3<double> force = Vector3<double>::Zero();
    if (i < spread.size()) force += spread[i];
    if (i > 0) force -= spread[i - 1];
    for (int axis = 0; axis < 3; ++axis) {
      const double x = p[i][axis];
      p[i][axis] = x + h;
      const double above = energy();
      p[i][axis] = x - h;
      const double below = energy();
      p[i][axis] = x;
      EXPECT_NEAR(force[axis], -(above - below) / (2 * h), 1e-7) << "particle " << i << " axis " << axis;
    }
  }
}

}  // namespace
}  // namespace ringlet::reference::test::core_spring_test
