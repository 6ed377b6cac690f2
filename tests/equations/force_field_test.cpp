// Tests reference/equations/force_field.h.
#include "reference/equations/force_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "tests/equations/strand_fixtures.h"

namespace ringlet::reference::test::force_field_test {
namespace {

using V = Vector3<double>;

// A free particle of a kilogram: its velocity after a step, in a frame that travels.
V step(const ForceField& field, const V& x, const V& v, const V& travel, double T) {
  const GoalPull<double> pull = fieldPull(field, x, travel, T);
  return (v + pull.momentum) / (1 + pull.weight);
}

TEST(ForceField, AlongAnAxisIsAnEvenAcceleration) {
  const ForceField field{.axis = {0, 3, 4}, .axial = 5};
  for (const V& x : {V(0, 0, 0), V(10, -2, 7)})
    EXPECT_LT((step(field, x, V(1, 0, 0), V::Zero(), 0.01) - V(1, 0.03, 0.04)).norm(), 1e-14);
}

TEST(ForceField, APlaceTurnsTheAxis) {
  const ForceField field{.place = {{1, 2, 3}, fromRotationVector(Vec3d{0, 0, std::numbers::pi / 2})},
                         .axis = {1, 0, 0},
                         .axial = 2};
  EXPECT_LT((fieldStrength(field, V(7, 8, 9)) - V(0, 2, 0)).norm(), 1e-14);
}

// Beyond its core a point pulls evenly, towards itself; within, as a spring of radial / core.
TEST(ForceField, APointPullsTowardsItself) {
  const ForceField field{.place = {{1, 0, 0}, {}}, .radial = -6, .core = 0.01};
  std::mt19937 random(3);
  for (const V& x : randomField(random, 40, 2)) {
    const V q = x - V(1, 0, 0);
    const V expected = -6 * q / std::hypot(q.norm(), 0.01);
    EXPECT_LT((fieldStrength(field, x) - expected).norm(), 1e-13);
  }
  EXPECT_EQ(fieldStrength(field, V(1, 0, 0)).norm(), 0.0);
  EXPECT_NEAR(fieldStrength(field, V(1 + 1e-6, 0, 0)).x(), -6e-6 / 0.01, 1e-9);
}

// A particle about a point, within its core, swings as a spring does.
TEST(ForceField, AParticleSwingsAboutAPoint) {
  const ForceField field{.radial = -1, .core = 1};  // k = 1 for amplitudes well below the core
  V x(0.001, 0, 0), v(0, 0, 0);
  const double T = 1e-3;
  int turns = 0;
  double last = 0, first = 0;
  for (int k = 1; k <= 20000; ++k) {
    const V next = step(field, x, v, V::Zero(), T);
    if (v.x() > 0 && next.x() <= 0) {
      last = k * T;
      if (turns++ == 0) first = last;
    }
    v = next;
    x += T * v;
  }
  ASSERT_GE(turns, 3);
  EXPECT_NEAR((last - first) / (turns - 1), 2 * std::numbers::pi, 0.01);
}

TEST(ForceField, ALinePullsAcrossItsAxisOnly) {
  const ForceField field{.axis = {0, 1, 0}, .aboutAxis = true, .radial = -3, .core = 0};
  EXPECT_LT((fieldStrength(field, V(2, 50, 0)) - V(-3, 0, 0)).norm(), 1e-14);
  EXPECT_LT((fieldStrength(field, V(0, -9, -0.5)) - V(0, 0, 3)).norm(), 1e-14);
  EXPECT_EQ(fieldStrength(field, V(0, 4, 0)).norm(), 0.0) << "on the axis";
}

// Right-handed, of the same size at all distances beyond its core, and without a component along or away.
TEST(ForceField, AVortexGoesRoundItsAxis) {
  const ForceField field{.axis = {0, 0, 1}, .aboutAxis = true, .around = 4, .core = 0};
  EXPECT_LT((fieldStrength(field, V(1, 0, 5)) - V(0, 4, 0)).norm(), 1e-14);
  std::mt19937 random(4);
  for (const V& x : randomField(random, 40, 1)) {
    const V F = fieldStrength(field, x);
    EXPECT_NEAR(F.norm(), 4, 1e-12);
    EXPECT_NEAR(F.z(), 0, 1e-14);
    EXPECT_NEAR(F.x() * x.x() + F.y() * x.y(), 0, 1e-12);
  }
}

TEST(ForceField, WeightsEndSmoothlyAtTheReach) {
  const ForceField field{.reach = 0.5};
  EXPECT_EQ(fieldWeight(field, 0), 1);
  EXPECT_NEAR(fieldWeight(field, 0.25), 0.5625, 1e-15);
  EXPECT_EQ(fieldWeight(field, 0.5), 0);
  EXPECT_EQ(fieldWeight(field, 0.7), 0);
  EXPECT_LT(fieldWeight(field, 0.4999) / 0.0001, 1e-2) << "its slope at the end is nothing";
  EXPECT_EQ(fieldWeight(ForceField{}, 1e6), 1) << "without a reach everywhere";
}

// What a front of speed c brings to a particle that hardly moves: the integral of its shell over time,
// strength * thickness / c * 16/15.
TEST(ForceField, ABlastKicksOnceAsItsFrontPasses) {
  ForceField field{.radial = 200, .core = 0, .thickness = 0.05};
  const double T = 1e-5, speed = 20;
  V v = V::Zero();
  for (int k = 0; k < 10000; ++k) {
    field.front = speed * T * k;
    v = step(field, V(0, 1, 0), v, V::Zero(), T);
  }
  EXPECT_NEAR(v.y(), 200 * 0.05 / speed * 16 / 15, 1e-4);
  EXPECT_EQ(v.x(), 0);
}

// However strong: the limit is the air's own velocity.
TEST(ForceField, DragTakesAlongWithoutOvershoot) {
  for (const double drag : {1.0, 100.0, 1e6}) {
    const ForceField field{.axis = {1, 0, 0}, .axial = 3, .drag = drag};
    const double T = 0.01;
    V v(0, 5, 0);
    for (int k = 1; k <= 5; ++k) {
      v = step(field, V::Zero(), v, V::Zero(), T);
      EXPECT_NEAR(v.x(), 3 * (1 - std::pow(1 + T * drag, -k)), 1e-9);
      EXPECT_NEAR(v.y(), 5 * std::pow(1 + T * drag, -k), 1e-9);
    }
  }
}

// What travels with the head feels the same air.
TEST(ForceField, AirIsTheSameSeenFromAMovingHead) {
  const ForceField field{.axis = {1, 0, 0}, .axial = 3, .drag = 7};
  const V travel(2, -1, 0.5), v(0.3, 0.2, 0.1);
  const V still = step(field, V::Zero(), v, V::Zero(), 0.01);
  const V seen = step(field, V::Zero(), v - travel, travel, 0.01);
  EXPECT_LT((seen + travel - still).norm(), 1e-14);
}

// A grid of a linear velocity is that velocity between its nodes, and nothing outside.
TEST(ForceField, AGridIsTrilinear) {
  auto grid = std::make_shared<VelocityGrid>(VelocityGrid{{3, 4, 5}, 0.5, {}});
  const auto linear = [](const V& x) { return V(1 + x.x(), 2 * x.y() - x.z(), 3 * x.z()); };
  for (int z = 0; z < 5; ++z)
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 3; ++x) {
        const V u = linear(V(0.5 * x, 0.5 * y, 0.5 * z));
        grid->velocities.push_back(static_cast<Vec3f>(Vec3d{u.x(), u.y(), u.z()}));
      }
  const Quatd turn = fromRotationVector(Vec3d{0.4, -0.2, 0.7});
  const ForceField field{.place = {{1, 2, 3}, turn}, .grid = grid, .gridShare = 2};
  for (const V& g : {V(0.1, 0.2, 0.3), V(1, 1.5, 2), V(0, 0, 0), V(0.99, 0.01, 1.99)}) {
    const V x = V(1, 2, 3) + toEigen<double>(turn) * g;
    const V expected = 2 * (toEigen<double>(turn) * linear(g));
    EXPECT_LT((fieldStrength(field, x) - expected).norm(), 1e-5) << g.transpose();
  }
  for (const V& g : {V(-0.01, 1, 1), V(0.5, 1.51, 1), V(0.5, 1, 2.01)})
    EXPECT_EQ(fieldStrength(field, V(1, 2, 3) + toEigen<double>(turn) * g).norm(), 0.0);
}

TEST(ForceField, RefusesNumbersOutOfRange) {
  const auto grid = std::make_shared<const VelocityGrid>(VelocityGrid{{2, 2, 2}, 1, std::vector<Vec3f>(7)});
  const ForceField wrong[] = {
      {.axis = {0, 0, 0}},
      {.axial = 1e7},
      {.radial = NAN},
      {.around = -INFINITY},
      {.core = -1},
      {.reach = 1e4},
      {.drag = -1},
      {.front = NAN},
      {.thickness = -0.1},
      {.grid = grid},
      {.place = {{NAN, 0, 0}, {}}},
      {.gridShare = 1e9},
  };
  for (const ForceField& field : wrong) EXPECT_FALSE(checkForceField(field));
  EXPECT_TRUE(checkForceField({}));
}

}  // namespace
}  // namespace ringlet::reference::test::force_field_test
