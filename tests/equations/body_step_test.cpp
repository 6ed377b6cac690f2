// Tests reference/kernels/body_step.h: strands that meet bodies.
#include "reference/kernels/body_step.h"

#include <gtest/gtest.h>

#include <random>

#include "reference/equations/body_contact.h"
#include "tests/equations/strand_fixtures.h"
#include "tests/support/sample_bodies.h"

namespace ringlet::reference::test::body_step_test {
namespace {

using ringlet::test::gridBall;

using Vector = Vector3<double>;

Material limp() {
  Material material;
  material.bendStiffness = 0.02;
  material.coreStiffness = 0;
  return material;
}

Simulation<double> among(const std::vector<Vec3f>& strand, const std::vector<Body>& bodies,
                         const Material& material = limp(), int stepsPerFrame = 8) {
  Settings settings;
  settings.gravityPreload = 0;
  settings.stepsPerFrame = stepsPerFrame;
  return {groomOf(strand), material, settings, {}, {}, {}, bodies};
}

double deepest(const Simulation<double>& simulation, const Body& body, std::size_t from = 1) {
  double depth = 0;
  const Rotation<double> rotation = toEigen<double>(body.place.rotation);
  for (std::size_t i = from; i < simulation.positions().size(); ++i) {
    const Vector y =
        rotation.conjugate() * (simulation.positions()[i] - toEigen<double>(body.place.position));
    depth = std::max(depth, -bodyDistance<double>(body, y).distance);
  }
  return depth;
}

// A strand that stands out and falls over a ball comes to lie on it.
TEST(BodyStep, FallsOnABallAndStaysOutside) {
  for (const Body& shape : {Body{.shape = BodyShape::sphere, .radius = 0.06}, gridBall(0.06, 0.003)}) {
    Body ball = shape;
    ball.place.position = {0.1, -0.1, 0};
    ball.friction = 0.8;  // else it would slide off to the side
    // As limp as hair is with 8 steps a frame: K_b 0.5 w.
    Material material = limp();
    material.bendStiffness = 0.5;
    auto simulation = among(straightStrand({0.25, 0, 0}, 64), {ball}, material);
    double worst = 0;
    for (int frame = 0; frame < 120; ++frame) {
      simulateStill(simulation, 1.0 / 24);
      worst = std::max(worst, deepest(simulation, ball));
    }
    EXPECT_LT(worst, 2e-5);
    EXPECT_LT(simulation.report().maxEdgeStretch, 1.1 + 1e-3);
    if (shape.shape == BodyShape::grid) continue;  // of a ball, on whose cells it slides off to a side
    // It hangs down on the ball's other side.
    EXPECT_GT(simulation.positions().back().x(), 0.1);
    EXPECT_LT(simulation.positions().back().y(), -0.05);
    EXPECT_LT(maxNorm(simulation.velocities()), 0.3);
  }
}

// Strands that grow above a body of each shape and lie down on it, from its middle to all sides: after a
// second and a half nothing moves any more.
TEST(BodyStep, HairOnABodyComesToRest) {
  for (const Body& shape : ringlet::test::sampleBodies()) {
    Body body = shape;
    body.friction = 0.3;
    double top = 1;
    for (int turn = 0; turn < 40; ++turn) top -= bodyDistance<double>(body, Vector(0, top, 0)).distance;
    body.place.position = {0.013, -top - 0.003, 0.007};
    for (int k = 0; k < 12; ++k) {
      const double turn = 2 * kPi * k / 12;
      auto simulation = among(straightStrand(Vec3d{0.09 * std::cos(turn), 0, 0.09 * std::sin(turn)}, 36),
                              {body}, Material{});
      simulateStill(simulation, 1.5);
      double moved = 0;  // in a step
      for (int step = 0; step < 24; ++step) {
        const Field<double> before = simulation.positions();
        simulateStill(simulation, simulation.settings().stepSeconds());
        moved = std::max(moved, maxDistance(before, simulation.positions()));
      }
      EXPECT_LT(moved, 1e-5) << shape.name << ", strand " << k;
    }
  }
}

// tan 24 deg < 0.5 < tan 29 deg: on the one slope it stays, on the other it slides, until what pulls it
// across is what friction holds: sin psi <= 0.5 / tan 29 deg.
TEST(BodyStep, StaysOnASlopeUpToTheFrictionAngle) {
  for (const double degrees : {24.0, 25.5, 27.7, 29.0, 40.0}) {
    Body slope{.shape = BodyShape::plane, .friction = 0.5};
    slope.place.rotation = fromRotationVector(Vec3d{0, 0, degrees * kPi / 180});
    auto simulation = among(straightStrand({0, 0, 0.25}, 32), {slope});
    simulateStill(simulation, 3);
    const double moved = (simulation.positions().back() - Vector(0, 0, 0.25)).norm();
    const double speed = maxNorm(simulation.velocities());
    if (std::tan(degrees * kPi / 180) < 0.5) {
      EXPECT_LT(moved, 1e-4) << degrees;
    } else {
      EXPECT_GT(moved, 0.005) << degrees;
      const double sine = std::abs(simulation.positions().back().z()) / simulation.positions().back().norm();
      EXPECT_LT(sine, 0.5 / std::tan(degrees * kPi / 180) + 0.02) << degrees;
    }
    EXPECT_LT(speed, 0.02) << degrees;
    EXPECT_LT(deepest(simulation, slope), 1e-5) << degrees;
  }
}

// 20 m/s against a ball of 1 cm, at any height, also between particles 16 mm apart.
TEST(BodyStep, NothingPassesABallAtTwentyMetresASecond) {
  for (const int particles : {16, 64}) {
    for (int k = 0; k < 10; ++k) {
      Body ball{.shape = BodyShape::sphere, .radius = 0.01, .friction = 0};
      const double height = -0.1 - 0.002 * k;
      ball.place.position = {0.05, height, 0};
      auto simulation = among(straightStrand({0, -0.25, 0}, particles), {ball});
      Field<double> positions = simulation.positions(), velocities = simulation.velocities();
      for (std::size_t i = 1; i < velocities.size(); ++i) velocities[i] = {20, 0, 0};
      simulation.setState(positions, velocities);
      simulateStill(simulation, 1.0 / 192);
      // The strand at the ball's height is still before it.
      for (std::size_t i = 0; i + 1 < positions.size(); ++i) {
        const Vector &a = simulation.positions()[i], &b = simulation.positions()[i + 1];
        if (!((a.y() - height) * (b.y() - height) <= 0)) continue;
        const double share = (height - a.y()) / (b.y() - a.y());
        EXPECT_LT((a + share * (b - a)).x(), 0.0402) << particles << " at " << height;
      }
      EXPECT_LT(deepest(simulation, ball), 1e-5);
    }
  }
}

// Strands that begin up to 5 cm deep in a ball, across it or with their tips in it: out within a second, no
// faster than 1 m/s, and not torn.
TEST(BodyStep, LeavesABodyGently) {
  for (const Vec3d place : {Vec3d{0.003, -0.15, 0.004}, Vec3d{0.03, -0.15, 0.02}, Vec3d{0.001, -0.25, 0}}) {
    Body ball{.shape = BodyShape::sphere, .radius = 0.05};
    ball.place.position = place;
    auto simulation = among(straightStrand({0, -0.25, 0}, 64), {ball}, Material{});
    double fastest = 0;
    for (int step = 0; step < 192; ++step) {
      simulateStill(simulation, 1.0 / 192);
      fastest = std::max(fastest, maxNorm(simulation.velocities()));
    }
    EXPECT_LT(deepest(simulation, ball), 1e-4);
    EXPECT_LT(fastest, 1);
    EXPECT_LT(simulation.report().maxEdgeStretch, 1.1 + 1e-4);
    RecordProperty("fastest", std::to_string(fastest));
  }
}

// A tip that begins a step inside and is thrown in: no deeper afterwards, or no deeper than allowed.
TEST(BodyStep, WhatBeginsInsideGoesNoDeeper) {
  for (const Body& shape :
       {Body{.shape = BodyShape::sphere, .radius = 0.04},
        Body{.shape = BodyShape::capsule, .radius = 0.03, .length = 0.03},
        Body{.shape = BodyShape::box, .halfExtents = {0.03, 0.02, 0.03}}, gridBall(0.04, 0.003)}) {
    for (const double depth : {2e-4, 1e-3, 1.9e-3, 2.2e-3}) {
      // The place above the body's middle that is so deep.
      double low = 0, high = 0.1;
      while (high - low > 1e-9) {
        const double middle = 0.5 * (low + high);
        (bodyDistance<double>(shape, Vector(0, middle, 0)).distance < -depth ? low : high) = middle;
      }
      Body body = shape;
      body.place.position = {0.25, -low, 0};
      for (const double speed : {1.0, 5.0, 20.0}) {
        auto simulation = among(straightStrand({0.25, 0, 0}, 16), {body});
        const Field<double> positions = simulation.positions();
        Field<double> velocities = simulation.velocities();
        for (std::size_t i = 1; i < velocities.size(); ++i) velocities[i] = {0, -speed, 0};
        simulation.setState(positions, velocities);
        simulateStill(simulation, 1.0 / 192);
        EXPECT_LT(deepest(simulation, body, 15), std::max(depth, -leastDistance(-depth)) + 1e-5)
            << speed << " m/s, from " << depth << " m";
      }
    }
  }
}

// A head that carries strand and ball along gives what both give at rest.
TEST(BodyStep, MovesWithTheHead) {
  Body ball{.shape = BodyShape::sphere, .radius = 0.06};
  ball.place.position = {0.1, -0.1, 0.003};
  Material material = limp();
  material.bendStiffness = 0.5;
  auto still = among(straightStrand({0.25, 0, 0}, 32), {ball}, material);
  simulateStill(still, 0.5);
  const Settings settings = still.settings();
  const auto pose = [](double t) { return HeadPose{Vec3d{3, 1, -2} * t, {}}; };
  Simulation<double> moving(groomOf(straightStrand({0.25, 0, 0}, 32)), material, settings, pose(0),
                            pose(-settings.stepSeconds()), {}, std::vector{ball});
  simulate(moving, 0.5, pose);
  EXPECT_LT(maxDistance(still.positions(), moving.positions()), 1e-7);
}

// An ideal edge over a thin rod: both ends swing down, the edge lies on the rod.
TEST(BodyStep, AnEdgeLiesOnARodThatNoParticleTouches) {
  Body rod{.shape = BodyShape::capsule, .radius = 0.001, .length = 0.2};
  rod.place = {{0.055, -0.02, 0}, fromRotationVector(Vec3d{kPi / 2, 0, 0})};
  auto simulation = among(straightStrand({0.11, 0, 0}, 8), {rod});  // edges of 16 mm
  simulateStill(simulation, 3);
  double passes = 1;  // of edges, how far above the rod's middle they go over it
  for (std::size_t i = 0; i + 1 < 8; ++i) {
    const Vector &a = simulation.positions()[i], &b = simulation.positions()[i + 1];
    const EdgeSurface<double> deepest = edgeDistance<double>(
        rod, toEigen<double>(rod.place.rotation).conjugate() * (a - toEigen<double>(rod.place.position)),
        toEigen<double>(rod.place.rotation).conjugate() * (b - toEigen<double>(rod.place.position)));
    if (deepest.isWithin) passes = std::min(passes, deepest.surface.distance);
  }
  EXPECT_GT(passes, -1e-4);
  EXPECT_LT(passes, 1e-3);
  EXPECT_GT(simulation.positions()[4].y(), -0.05);
}

}  // namespace
}  // namespace ringlet::reference::test::body_step_test
