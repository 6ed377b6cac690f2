// Tests reference/equations/goal_spring.h.
#include "reference/equations/goal_spring.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ringlet/rest/goal.h"
#include "tests/equations/strand_fixtures.h"

namespace ringlet::reference::test::goal_spring_test {
namespace {

// A free particle of a kilogram: its velocity after the step.
Vector3<double> step(const GoalPull<double>& pull, const Vector3<double>& v) {
  return (v + pull.momentum) / (1 + pull.weight);
}

TEST(GoalSpring, IsTheImplicitStepOfSpringAndDamper) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Field<double> r = randomField(random, 4, 1);
    const Vector3<double>&x = r[0], &v = r[1], &before = r[2], &after = r[3];
    const double k = 3 + trial, c = 0.5 * trial, T = 0.01;
    const Vector3<double> next = step(goalPull(k, c, x, before, after, T), v);
    const Vector3<double> moved = x + T * next, speed = (after - before) / T;
    EXPECT_LT(((next - v) / T - (k * (after - moved) + c * (speed - next))).norm(), 1e-10);
  }
}

TEST(GoalSpring, AParticleAtAGoalThatStandsStaysThere) {
  const Vector3<double> x(0.1, -0.2, 0.3);
  EXPECT_EQ(step(goalPull(1000.0, 60.0, x, x, x, 0.005), Vector3<double>::Zero()).norm(), 0.0);
}

TEST(GoalSpring, AParticleThatMovesWithItsGoalGoesOn) {
  const double T = 0.005;
  const Vector3<double> x(0.1, -0.2, 0.3), v(1, 0.5, -2);
  const Vector3<double> next = step(goalPull(500.0, 30.0, x, x, Vector3<double>(x + T * v), T), v);
  EXPECT_LT((next - v).norm(), 1e-12);
}

TEST(GoalSpring, AnyStrengthIsStableAndTheStrongestIsTheGoal) {
  const double T = 1.0 / 96;
  const Vector3<double> goal(0, 0, 0);
  for (const double strength : {0.01, 1.0, 100.0, 1e4, 1e8}) {
    const double k = goalStiffness(strength), c = goalDamping(k, 1);
    Vector3<double> x(0.1, 0, 0), v(0, 3, 0);
    double farthest = 0;
    for (int i = 0; i < 2000; ++i) {
      v = step(goalPull(k, c, x, goal, goal, T), v);
      x += T * v;
      farthest = std::max(farthest, x.norm());
    }
    EXPECT_LT(farthest, 0.5) << strength;
    EXPECT_LT(x.norm(), strength < 1 ? 0.1 : 1e-6) << strength;
  }
  // What is left of the way in one step: (1 + T c) / (1 + T c + T^2 k).
  const double k = goalStiffness(1e8), c = goalDamping(k, 1);
  const double left = (1 + T * c) / (1 + T * c + T * T * k);
  const Vector3<double> x(0.1, 0, 0), y(0.3, 0.2, 0);
  const Vector3<double> v = step(goalPull(k, c, x, y, y, T), Vector3<double>::Zero());
  EXPECT_NEAR((x + T * v - y).norm(), left * (x - y).norm(), 1e-12);
  EXPECT_LT(left, 1e-3);
}

// What the units say: a goal of strength 1 holds a particle's weight a centimetre below it.
TEST(GoalSpring, AStrengthOfOneHoldsTheWeightAtACentimetre) {
  const double k = goalStiffness(1), T = 1.0 / 200;
  const Vector3<double> gravity(0, -kStandardGravity, 0), goal(0, 0, 0);
  Vector3<double> x = goal, v = Vector3<double>::Zero();
  for (int i = 0; i < 4000; ++i) {
    v = step(goalPull(k, goalDamping(k, 1), x, goal, goal, T), v + T * gravity);
    x += T * v;
  }
  EXPECT_LT((x - Vector3<double>(0, -0.01, 0)).norm(), 1e-9);
}

// The ratio's law: critical damping comes back without passing the goal, less of it passes.
TEST(GoalSpring, ARatioOfOneIsCritical) {
  const double k = goalStiffness(1), T = 1e-5;
  for (const double ratio : {0.2, 1.0}) {
    Vector3<double> x(0.01, 0, 0), v = Vector3<double>::Zero();
    double least = 0;
    for (int i = 0; i < 100000; ++i) {
      v = step(goalPull(k, goalDamping(k, ratio), x, Vector3<double>(0, 0, 0), Vector3<double>(0, 0, 0), T),
               v);
      x += T * v;
      least = std::min(least, x.x());
    }
    // The first overshoot of a damped oscillator: exp(-pi z / sqrt(1 - z^2)).
    const double expected = ratio < 1 ? 0.01 * std::exp(-M_PI * ratio / std::sqrt(1 - ratio * ratio)) : 0;
    EXPECT_NEAR(-least, expected, 2e-5) << ratio;
  }
}

// What the units of shapes say, however finely a strand is cut: an edge gives way to the weight w' beyond it
// by w' / (strength w) of its length. Straight hair to the side, with next to no springs of its own.
TEST(GoalSpring, AShapeHoldsItsWeight) {
  constexpr double kArc = 0.25, kStrength = 50;
  for (const int particles : {16, 64}) {
    Settings settings;
    settings.gravity = {};  // the rest pose is balanced against none
    settings.goal = {.on = true, .strength = kStrength, .shape = true};
    Material material;
    material.bendStiffness = material.coreStiffness = 1e-3;
    const Groom groom = groomOf(straightStrand({kArc, 0, 0}, particles));
    Simulation<double> simulation(groom, material, settings);
    settings.gravity = {0, -kStandardGravity, 0};
    simulation.change(groom, material, settings);
    const HeadPose pose;
    for (int step = 0; step < 480; ++step) simulation.stepFrame(std::span(&pose, 1));
    const RestStrand<double>& rest = simulation.restStrands()[0];
    double all = 0, beyond = 0, droop = 0;
    for (const double m : rest.masses) all += m;
    for (std::size_t i = rest.edgeCount(); i-- > 0;) {
      beyond += rest.masses[i + 1];
      droop += rest.edgeLengths[i] * beyond / (kStrength * all);
    }
    EXPECT_NEAR(droop, kArc / 2 / kStrength, 0.05 * kArc / 2 / kStrength) << particles;
    const Vector3<double> tip = simulation.positions().back();
    EXPECT_NEAR(-tip.y(), droop, 0.01 * droop) << particles;
  }
}

}  // namespace
}  // namespace ringlet::reference::test::goal_spring_test
