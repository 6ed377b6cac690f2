// Tests reference/kernels/strand_step.h and reference/step.h: invariants of one step, and motion of one
// strand.
#include "reference/kernels/strand_step.h"

#include <gtest/gtest.h>

#include "ringlet/scene/motion.h"
#include "tests/equations/strand_fixtures.h"

namespace ringlet::reference::test::strand_step_test {
namespace {

Settings settingsFor(Integrator integrator) {
  Settings settings;
  settings.integrator = integrator;
  if (integrator == Integrator::paper) {
    settings.stepsPerFrame = 30;
    settings.gravityPreload = 0;
  }
  return settings;
}
constexpr Integrator kIntegrators[] = {Integrator::jacobi, Integrator::pointJacobi, Integrator::paper};

// A simulation thrown out of its rest pose: every particle but the root moved by up to 1 mm, at up to 0.5
// m/s.
template <class Real>
void disturb(Simulation<Real>& simulation, const Rotation<double>& turn) {
  std::mt19937 random(21);
  Field<Real> positions = simulation.positions(), velocities = simulation.velocities();
  for (std::size_t i = 1; i < positions.size(); ++i) {
    positions[i] += (turn * randomVector(random, 0.001)).template cast<Real>();
    velocities[i] += (turn * randomVector(random, 0.5)).template cast<Real>();
  }
  simulation.setState(positions, velocities);
}

Field<double> turnedBy(const Rotation<double>& turn, const Field<double>& field) {
  Field<double> turned;
  for (const Vector3<double>& v : field) turned.push_back(turn * v);
  return turned;
}

// Head, strand and gravity turned together: everything the step computes turns with them.
TEST(StrandStep, TurnsWithARigidRotation) {
  std::mt19937 random(4);
  const Rotation<double> turn = randomRotation(random);
  const Groom groom = groomOf(Helix{}.points());
  for (const Integrator integrator : kIntegrators) {
    Settings settings = settingsFor(integrator);
    settings.gravityPreload = 0;  // the preload balances the rest pose's gravity, in the groom's axes
    Settings turnedSettings = settings;
    const Vector3<double> gravity = turn * toEigen<double>(settings.gravity);
    turnedSettings.gravity = {gravity.x(), gravity.y(), gravity.z()};
    const HeadPose turnedHead{{}, toQuat(turn)};
    Simulation<double> plain(groom, Material{}, settings),
        turned(groom, Material{}, turnedSettings, turnedHead);
    disturb(plain, Rotation<double>::Identity());
    disturb(turned, turn);
    simulateStill(plain, settings.stepSeconds());
    simulateStill(turned, settings.stepSeconds());
    const StrandTaps<double>&a = plain.taps()[0], &b = turned.taps()[0];
    for (const auto field :
         {&StrandTaps<double>::smoothedEdges, &StrandTaps<double>::coreEdges, &StrandTaps<double>::targets,
          &StrandTaps<double>::stretchForces, &StrandTaps<double>::bendForces,
          &StrandTaps<double>::coreForces, &StrandTaps<double>::solvedVelocities,
          &StrandTaps<double>::positions, &StrandTaps<double>::velocities}) {
      EXPECT_LT(maxDistance(turnedBy(turn, a.*field), b.*field), 1e-10 * maxNorm(a.*field));
    }
  }
}

TEST(StrandStep, SpringForcesSumToZero) {
  const Groom groom = groomOf(Helix{}.points());
  for (const Integrator integrator : kIntegrators) {
    Simulation<double> simulation(groom, Material{}, settingsFor(integrator));
    disturb(simulation, Rotation<double>::Identity());
    simulateStill(simulation, simulation.settings().stepSeconds());
    Vector3<double> sum = Vector3<double>::Zero();
    double size = 0;
    for (std::size_t i = 0; i < groom.points.size(); ++i) {
      sum += particleForce(simulation.taps()[0], i);
      size += particleForce(simulation.taps()[0], i).norm();
    }
    EXPECT_LT(sum.norm(), 1e-13 * size);
  }
}

TEST(StrandStep, ARestStrandWithoutGravityStaysPut) {
  const Groom groom = groomOf(Helix{}.points());
  for (const Integrator integrator : {Integrator::jacobi, Integrator::pointJacobi}) {
    Settings settings = settingsFor(integrator);
    settings.gravity = {};
    Simulation<double> simulation(groom, Material{}, settings);
    const Field<double> rest = simulation.positions();
    simulateStill(simulation, 1);
    EXPECT_LT(maxDistance(simulation.positions(), rest), 1e-12);
    EXPECT_EQ(simulation.report().limitedEdges, 0u);
    EXPECT_EQ(simulation.report().nonfinite, 0u);
  }
}

TEST(StrandStep, AtConstantHeadVelocityTheHairIsRigid) {
  const Groom groom = groomOf(Helix{}.points());
  const Settings settings = settingsFor(Integrator::jacobi);
  Motion glide = *motionByName("glide", {0, 1, 0});
  glide.axis = {0.6, 0, 0.8};
  Simulation<double> simulation(groom, Material{}, settings, glide.poseAt(0),
                                glide.poseAt(-settings.stepSeconds()));
  const Field<double> rest = simulation.positions();
  simulate(simulation, 1, [&](double t) { return glide.poseAt(t); });
  EXPECT_LT(maxDistance(simulation.positions(), rest), 1e-9);
  EXPECT_LT(maxNorm(simulation.velocities()), 1e-9);
}

// The head starts to move by v over one step: relative to it everything not held then moves by -v T, less
// what the springs and their damping pass on; at the free tip of a long strand, nearly nothing.
TEST(StrandStep, AJerkOfTheHeadLeavesTheTipBehind) {
  const Groom groom = groomOf(Helix{.particleCount = 128}.points());
  const Settings settings = settingsFor(Integrator::jacobi);
  Simulation<double> simulation(groom, Material{}, settings);
  const Vector3<double> tip = simulation.positions().back();
  const double shift = 0.002;
  const HeadPose moved{{shift, 0, 0}, {}};
  simulation.stepFrame(std::span(&moved, 1));
  EXPECT_LT((simulation.positions().back() - tip + Vector3<double>(shift, 0, 0)).norm(), 0.1 * shift);
  EXPECT_EQ(simulation.positions().front(), simulation.restStrands()[0].points[0]);
}

TEST(StrandStep, PinnedParticlesFollowTheHeadsTurn) {
  const Groom groom = groomOf(Helix{}.points());
  Settings settings = settingsFor(Integrator::jacobi);
  settings.rootCount = 3;
  const Motion nod = *motionByName("nod", {0, 1, 0});
  Simulation<double> simulation(groom, Material{}, settings);
  simulate(simulation, 0.4, [&](double t) { return nod.poseAt(t); });
  const Rotation<double> now = toEigen<double>(simulation.head().rotation);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((simulation.positions()[i] - now * simulation.restStrands()[0].points[i]).norm(), 1e-15);
  }
}

// Shifted roots are where the head carries the shifted place, and so fast as both together.
TEST(StrandStep, ShiftedRootsFollowTheHeadToo) {
  Groom groom = groomOf(Helix{}.points());
  groom.addStrand(Helix{.turns = 4}.points());
  const Settings settings = settingsFor(Integrator::jacobi);
  const Motion nod = *motionByName("nod", {0, 1, 0});
  Simulation<double> simulation(groom, Material{}, settings);
  const Vec3d shift{0.01, 0.002, -0.03};
  simulation.setRootShifts(std::vector<Vec3d>{shift, {}});
  Vector3<double> before = simulation.positions().front();
  for (int n = 1; n <= 80; ++n) {
    HeadPose pose = nod.poseAt(n * settings.stepSeconds());
    pose.shift = n / 80.0;
    simulation.stepFrame(std::span(&pose, 1));
    const Rotation<double> now = toEigen<double>(pose.rotation);
    const Vector3<double> place =
        now * (simulation.restStrands()[0].points[0] + pose.shift * toEigen<double>(shift));
    EXPECT_LT((simulation.positions().front() - place).norm(), 1e-15);
    EXPECT_LT((simulation.velocities().front() - (place - before) / settings.stepSeconds()).norm(), 1e-13);
    EXPECT_LT((simulation.positions()[64] - now * simulation.restStrands()[1].points[0]).norm(), 1e-15);
    before = place;
  }
}

// At constant turning the first step's state is the rigid motion: positions R p, velocities (R p - R_before
// p) / T.
TEST(StrandStep, StartsWithTheHeadsTurn) {
  const Groom groom = groomOf(Helix{}.points());
  const Settings settings = settingsFor(Integrator::jacobi);
  const double T = settings.stepSeconds();
  const Vec3d axis{0, 1, 0};
  const HeadPose start{{}, fromRotationVector(axis * 0.3)},
      before{{}, fromRotationVector(axis * (0.3 - 2 * T))};
  const Simulation<double> simulation(groom, Material{}, settings, start, before);
  const Vector3<double> omega = 2 * toEigen<double>(axis);
  for (std::size_t i = 0; i < simulation.positions().size(); ++i) {
    const Vector3<double>& p = simulation.positions()[i];
    EXPECT_LT((p - toEigen<double>(start.rotation) * simulation.restStrands()[0].points[i]).norm(), 1e-15);
    EXPECT_LT((simulation.velocities()[i] - omega.cross(p)).norm(), 2 * omega.norm() * T * p.norm());
  }
}

TEST(StrandStep, PointJacobiConvergesToJacobi) {
  const Groom groom = groomOf(Helix{.particleCount = 32}.points());
  const auto motionOf = [&](Integrator integrator, int iterations, bool chebyshev) {
    Settings settings = settingsFor(integrator);
    settings.pointIterations = iterations;
    settings.chebyshev = chebyshev;
    Simulation<double> simulation(groom, Material{}, settings);
    disturb(simulation, Rotation<double>::Identity());
    simulateStill(simulation, 0.1);
    return simulation.positions();
  };
  const Field<double> exact = motionOf(Integrator::jacobi, 0, false);
  EXPECT_LT(maxDistance(motionOf(Integrator::pointJacobi, 4000, true), exact), 1e-10);
  EXPECT_LT(maxDistance(motionOf(Integrator::pointJacobi, 40000, false), exact), 1e-10);
}

TEST(StrandStep, ThePaperIsStableAtItsOwnSteps) {
  const Settings settings = settingsFor(Integrator::paper);
  const Motion shake = *motionByName("shake", {0, 1, 0});
  for (const int particleCount : {32, 64}) {
    Simulation<double> simulation(groomOf(Helix{.particleCount = particleCount}.points()), Material{},
                                  settings);
    simulate(simulation, 1, [&](double t) { return shake.poseAt(t); });
    const Report report = simulation.report();
    EXPECT_EQ(report.nonfinite, 0u);
    EXPECT_LE(report.maxEdgeStretch, settings.maxStretch * (1 + 1e-12));
    // Nothing is faster than a fall of a second and the head (1.3 m/s) together.
    EXPECT_LT(maxNorm(simulation.velocities()), 9.81 + 1.3);
    EXPECT_LT(maxNorm(simulation.positions()), settings.maxStretch * simulation.restStrands()[0].arcLength);
  }
}

// Through hard shaking float stays beside double: the solve keeps the mass.
TEST(StrandStep, FloatFollowsDouble) {
  const Groom groom = groomOf(Helix{}.points());
  const Settings settings = settingsFor(Integrator::jacobi);
  const Motion shake = *motionByName("shake", {0, 1, 0});
  Simulation<double> exact(groom, Material{}, settings);
  Simulation<float> single(groom, Material{}, settings);
  simulate(exact, 0.5, [&](double t) { return shake.poseAt(t); });
  simulate(single, 0.5, [&](double t) { return shake.poseAt(t); });
  // 100 steps; a prototype measured 2.3e-7 m for the float solver.
  EXPECT_LT(maxDistance(single.positions(), exact.positions()), 5e-6);
}

TEST(StrandStep, StrandsTooShortToMoveAreRigid) {
  Groom groom;
  groom.metresPerUnit = 1;
  groom.addStrand(std::vector<Vec3f>{{0.1f, 0, 0}});
  groom.addStrand(std::vector<Vec3f>{{0.1f, 0, 0}, {0.2f, 0, 0}});
  groom.addStrand(std::vector<Vec3f>{});
  groom.addStrand(Helix{}.points());
  const Motion nod = *motionByName("nod", {0, 1, 0});
  for (const Integrator integrator : kIntegrators) {
    Settings settings = settingsFor(integrator);
    settings.rootCount = 2;
    Simulation<double> simulation(groom, Material{}, settings);
    simulate(simulation, 0.2, [&](double t) { return nod.poseAt(t); });
    const Rotation<double> now = toEigen<double>(simulation.head().rotation);
    EXPECT_LT((simulation.positions()[0] - now * simulation.restStrands()[0].points[0]).norm(), 1e-15);
    EXPECT_LT((simulation.positions()[2] - now * simulation.restStrands()[1].points[1]).norm(), 1e-15);
    EXPECT_EQ(simulation.report().nonfinite, 0u);
  }
}

}  // namespace
}  // namespace ringlet::reference::test::strand_step_test
