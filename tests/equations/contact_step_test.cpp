// Tests reference/kernels/contact_step.h and the contacts of reference/step.h: what a step conserves, how its
// iteration converges, and strands that meet.
#include "reference/kernels/contact_step.h"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "ringlet/scene/motion.h"
#include "tests/equations/contact_fixtures.h"

namespace ringlet::reference::test::contact_step_test {
namespace {

// ---- the solve, on systems of its own

// Three strands of 5, 4 and 6 particles, their roots pinned, any two particles of different strands in
// contact with a chance of one in three, at up to 300 times the mass.
struct MetStrands {
  std::vector<std::uint32_t> firstPoint{0, 5, 9, 15};
  std::vector<StrandSystem> systems;
  Contacts<double> contacts;
  Field<double> start;  // v^0, pinned velocities with it

  MetStrands() {
    std::mt19937 random(9);
    start = randomField(random, 15, 1);
    SolveScratch scratch;
    for (std::uint32_t s = 0; s < 3; ++s) {
      StrandSystem& system = systems.emplace_back();
      for (std::uint32_t i = firstPoint[s]; i < firstPoint[s + 1]; ++i) {
        contacts.particles.push_back({.index = i, .strand = s, .isPinned = i == firstPoint[s]});
        contacts.isPinned.push_back(i == firstPoint[s]);
        system.masses.push_back(1 + randomVector(random, 0.5).x());
        system.momenta.push_back(randomVector(random, 1));
        if (i + 1 == firstPoint[s + 1]) break;
        system.along.push_back(100);
        system.across.push_back(5);
        system.directions.push_back(randomVector(random, 1).normalized());
      }
      solveStrand(system, scratch,
                  std::span(start).subspan(firstPoint[s], firstPoint[s + 1] - firstPoint[s]));
    }
    for (std::uint32_t a = 0; a < 15; ++a) {
      for (std::uint32_t b = a + 1; b < 15; ++b) {
        if (contacts.particles[a].strand == contacts.particles[b].strand || random() % 3 != 0) continue;
        contacts.live.push_back({.pair = {a, b},
                                 .normal = randomVector(random, 1).normalized(),
                                 .weights = {.damping = 100 + 200 * randomVector(random, 1).x(),
                                             .tangential = 10,
                                             .push = std::abs(randomVector(random, 20).x())}});
        contacts.live.back().weights.damping = std::max(20.0, contacts.live.back().weights.damping);
      }
    }
  }

  Field<double> solved(int iterationCount) {
    Field<double> velocities = start;
    SolveScratch scratch;
    for (StrandSystem& system : systems) system.contactWeights.clear(), system.contactMomenta.clear();
    const auto solveOne = [&](std::size_t s, std::span<Vector3<double>> of) {
      solveStrand(systems[s], scratch, of);
    };
    ContactSettings settings;
    settings.iterations = iterationCount;
    const VolumeFrame still{Rotation<double>::Identity(), Rotation<double>::Identity(), 1};
    solveContacts(settings, still, firstPoint, systems, solveOne, start, contacts, velocities);
    return velocities;
  }
};

// Strands and contacts as one dense system A v = r of all 15 particles, rows of pinned ones v = given; M is
// the part the iteration inverts.
struct CoupledSystem {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(45, 45), M = A;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(45);
  std::vector<Eigen::Index> freeRows;

  static Eigen::Index row(std::size_t i) { return static_cast<Eigen::Index>(3 * i); }

  explicit CoupledSystem(const MetStrands& strands) {
    const auto add = [](Eigen::MatrixXd& matrix, std::size_t i, std::size_t j, const Matrix3<double>& block) {
      matrix.block<3, 3>(row(i), row(j)) += block;
    };
    for (std::size_t s = 0; s < 3; ++s) {
      const StrandSystem& system = strands.systems[s];
      for (std::size_t k = 0; k < system.particleCount(); ++k) {
        const std::size_t i = strands.firstPoint[s] + k;
        add(A, i, i, system.masses[k] * Matrix3<double>::Identity());
        right.segment<3>(row(i)) += system.momenta[k];
        if (k + 1 == system.particleCount()) break;
        for (const std::size_t end : {i, i + 1}) {
          add(A, end, end, system.edgeBlock(k));
          add(A, end, 2 * i + 1 - end, -system.edgeBlock(k));
        }
      }
    }
    M = A;
    for (const Contact<double>& contact : strands.contacts.live) {
      const Matrix3<double> Q = contactMatrix(contact.weights, contact.normal);
      const std::size_t a = contact.pair.a, b = contact.pair.b;
      for (const std::size_t end : {a, b}) {
        add(A, end, end, Q);
        add(A, end, a + b - end, -Q);
        add(M, end, end, 2 * Q);
        right.segment<3>(row(end)) += (end == a ? 1 : -1) * contact.weights.push * contact.normal;
      }
    }
    for (std::size_t i = 0; i < 15; ++i) {
      if (strands.contacts.particles[i].isPinned) continue;
      for (Eigen::Index k = 0; k < 3; ++k) freeRows.push_back(row(i) + k);
    }
  }

  static Eigen::VectorXd flat(const Field<double>& velocities) {
    Eigen::VectorXd result(45);
    for (std::size_t i = 0; i < 15; ++i) result.segment<3>(row(i)) = velocities[i];
    return result;
  }
  /// r - A v of the free rows.
  Eigen::VectorXd residual(const Field<double>& velocities) const {
    return (right - A * flat(velocities))(freeRows);
  }
};

TEST(ContactSolve, ResidualFallsWithEveryIteration) {
  MetStrands strands;
  const CoupledSystem coupled(strands);
  const Eigen::LLT<Eigen::MatrixXd> inverted(coupled.M(coupled.freeRows, coupled.freeRows));
  // In M's own norm, in which the iteration is symmetric.
  const auto size = [&](const Field<double>& velocities) {
    const Eigen::VectorXd r = coupled.residual(velocities);
    return std::sqrt(r.dot(inverted.solve(r)));
  };
  double before = size(strands.start);
  for (int iterations = 1; iterations <= 40; ++iterations) {
    const double now = size(strands.solved(iterations));
    EXPECT_LT(now, before);
    before = now;
  }
  EXPECT_LT(size(strands.solved(20000)), 1e-12);
}

TEST(ContactSolve, ConvergesToTheDenseSolution) {
  MetStrands strands;
  const CoupledSystem coupled(strands);
  const Field<double> found = strands.solved(20000);
  Eigen::VectorXd given = CoupledSystem::flat(strands.start);
  for (const Eigen::Index row : coupled.freeRows) given[row] = 0;
  const Eigen::VectorXd right = (coupled.right - coupled.A * given)(coupled.freeRows);
  const Eigen::VectorXd expected = coupled.A(coupled.freeRows, coupled.freeRows).llt().solve(right);
  EXPECT_LT((CoupledSystem::flat(found)(coupled.freeRows) - expected).norm(), 1e-9 * expected.norm());
  EXPECT_LT(maxDistance(found, strands.solved(40000)), 1e-9);
  EXPECT_LT(strands.contacts.momentumError, 1e-9);
}

// A spring seen ahead (its push is below 0) that the last iterate does not bring about is taken back, its
// damper stays; one that it does bring about stays whole.
TEST(ContactSolve, TakesBackWhatDoesNotComeAbout) {
  for (const double separation : {-1.0, -0.1, 0.1}) {
    MetStrands strands;
    auto& contact = strands.contacts.live.front();
    contact.weights = {
        .spring = 100, .damping = 7, .push = -50};  // met if they near each other at 0.5 or more
    Field<double> velocities(15, Vector3<double>::Zero());
    velocities[contact.pair.a] = separation * contact.normal;
    const bool isUnmet = separation > -0.5;
    EXPECT_EQ(dropUnmet(velocities, strands.contacts), isUnmet) << separation;
    EXPECT_EQ(strands.contacts.live.front().weights.spring, isUnmet ? 0 : 100);
    EXPECT_EQ(strands.contacts.live.front().weights.damping, 7);
    EXPECT_EQ(strands.contacts.live.front().weights.push, isUnmet ? 0 : -50);
  }
}

// Whatever the stiffness: M^-1 (M - A) has real eigenvalues in [0, 1).
TEST(ContactSolve, NeverOvershoots) {
  for (const double stiffer : {1e-3, 1.0, 1e4}) {
    MetStrands strands;
    for (auto& contact : strands.contacts.live) {
      contact.weights.damping *= stiffer;
      contact.weights.tangential *= stiffer;
    }
    const CoupledSystem coupled(strands);
    const Eigen::MatrixXd A = coupled.A(coupled.freeRows, coupled.freeRows),
                          M = coupled.M(coupled.freeRows, coupled.freeRows);
    const Eigen::VectorXd eigenvalues =
        Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(M - A, M).eigenvalues();
    EXPECT_GT(eigenvalues.minCoeff(), -1e-12);
    EXPECT_LT(eigenvalues.maxCoeff(), 1);
  }
}

// ---- strands that meet

// Six curls in two rows, their spheres overlapping at rest.
Groom swatch() {
  Groom groom;
  groom.metresPerUnit = 1;
  std::mt19937 random(4);
  for (int k = 0; k < 6; ++k) {
    const double turn = randomVector(random, 3).x();
    std::vector<Vec3f> points;
    for (int i = 0; i < 32; ++i) {
      const Vec3d p = Helix{}.at(i / 31.0);
      points.push_back(Vec3f(Vec3d{std::cos(turn) * p.x + std::sin(turn) * p.z + 0.022 * (k % 3), p.y,
                                   std::cos(turn) * p.z - std::sin(turn) * p.x + 0.022 * (k / 3)}));
    }
    groom.addStrand(points);
  }
  return groom;
}
Settings swatchSettings() {
  Settings settings;
  settings.contacts.on = true;
  settings.contacts.method = ContactMethod::explicitPairs;
  settings.contacts.minOverlaps = 1;
  return settings;
}

TEST(ContactStep, RestPoseStaysAtRest) {
  const Groom groom = swatch();
  Simulation<double> simulation(groom, Material{}, swatchSettings());
  const Field<double> rest = simulation.positions();
  // Not for want of contacts: some spheres overlap.
  int overlaps = 0;
  for (const ContactParticle& a : simulation.contacts().particles) {
    for (const ContactParticle& b : simulation.contacts().particles) {
      overlaps += a.strand < b.strand && (a.restPlace - b.restPlace).norm() < 0.9 * (a.radius + b.radius);
    }
  }
  EXPECT_GT(overlaps, 50);
  simulateStill(simulation, 2);
  EXPECT_EQ(simulation.report().contacts, 0u);
  EXPECT_LT(maxNorm(simulation.velocities()), 1e-12);
  EXPECT_LT(maxDistance(simulation.positions(), rest), 1e-12);
}

TEST(ContactStep, AtConstantHeadVelocityTheHairIsRigid) {
  Motion glide = *motionByName("glide", {0, 1, 0});
  glide.axis = {0.6, 0, 0.8};
  const Settings settings = swatchSettings();
  Simulation<double> simulation(swatch(), Material{}, settings, glide.poseAt(0),
                                glide.poseAt(-settings.stepSeconds()));
  const Field<double> rest = simulation.positions();
  simulate(simulation, 1, [&](double t) { return glide.poseAt(t); });
  EXPECT_LT(maxDistance(simulation.positions(), rest), 1e-9);
  EXPECT_LT(maxNorm(simulation.velocities()), 1e-9);
}

// What contacts give at the step's start, push n - Q (v_a - v_b) at v^0, cancels.
TEST(ContactStep, MomentumAtTheStartOfAStepSumsToZero) {
  const Groom groom = swatch();
  Simulation<double> simulation(groom, Material{}, swatchSettings());
  disturb(simulation, groom.firstPoint);
  simulateStill(simulation, 3 * simulation.settings().stepSeconds());
  const Contacts<double>& contacts = simulation.contacts();
  EXPECT_GT(contacts.live.size(), 50u);
  const Field<double> momenta = pairMomenta(contacts, contacts.freeVelocities);
  Vector3<double> sum = Vector3<double>::Zero();
  double size = 0;
  for (std::size_t i = 0; i < momenta.size(); ++i) {
    const Vector3<double> given = momenta[i] - 2 * contacts.weights[i] * contacts.freeVelocities[i];
    sum += given;
    size += given.norm();
  }
  EXPECT_LT(sum.norm(), 1e-12 * size);
  // The whole step's error is the iteration's, and goes with it.
  EXPECT_GT(contacts.momentumError, 1e-4);
  Settings many = swatchSettings();
  many.contacts.iterations = 1000;
  Simulation<double> converged(groom, Material{}, many);
  disturb(converged, groom.firstPoint);
  simulateStill(converged, many.stepSeconds());
  EXPECT_LT(converged.report().momentumError, 1e-9);
}

TEST(ContactStep, TurnsWithARigidRotation) {
  std::mt19937 random(4);
  const Rotation<double> turn = randomRotation(random);
  Settings settings = swatchSettings();
  settings.gravityPreload = 0;
  Settings turnedSettings = settings;
  const Vector3<double> gravity = turn * toEigen<double>(settings.gravity);
  turnedSettings.gravity = {gravity.x(), gravity.y(), gravity.z()};
  const Groom groom = swatch();
  Simulation<double> plain(groom, Material{}, settings),
      turned(groom, Material{}, turnedSettings, HeadPose{{}, toQuat(turn)});
  disturb(plain, groom.firstPoint);
  Field<double> positions, velocities;
  for (const auto& p : plain.positions()) positions.push_back(turn * p);
  for (const auto& v : plain.velocities()) velocities.push_back(turn * v);
  turned.setState(positions, velocities);
  simulateStill(plain, 3 * settings.stepSeconds());
  simulateStill(turned, 3 * settings.stepSeconds());
  EXPECT_EQ(plain.report().contacts, turned.report().contacts);
  positions.clear();
  for (const auto& p : plain.positions()) positions.push_back(turn * p);
  EXPECT_LT(maxDistance(positions, turned.positions()), 1e-11);
}

// Two straight strands that fly at each other in mirrored states, slowly enough that only opposite particles
// meet: a pair's mean is zero, and an iteration has it right; as it has after springs that would pull were
// taken back, and there is nothing more to do.
TEST(ContactStep, ASymmetricHitIsRightAtOnce) {
  Groom groom;
  groom.metresPerUnit = 1;
  for (const double side : {-1.0, 1.0}) {
    std::vector<Vec3f> strand = straightStrand({0, -0.2, 0}, 21);
    for (Vec3f& p : strand) p.x = static_cast<float>(0.01 * side);
    groom.addStrand(strand);
  }
  const auto afterSteps = [&](int iterations, bool on) {
    Settings settings = meetingSettings(0.005);
    settings.contacts.iterations = iterations;
    settings.contacts.on = on;
    Simulation<double> simulation(groom, Material{}, settings);
    Field<double> velocities;
    for (const Vector3<double>& p : simulation.positions()) velocities.push_back({200 * p.x() * p.y(), 0, 0});
    simulation.setState(simulation.positions(), velocities);
    simulateStill(simulation, 0.2);
    return simulation.positions();
  };
  const Field<double> two = afterSteps(2, true), three = afterSteps(3, true);
  EXPECT_LT(maxDistance(two, three), 2e-6);  // where the last springs are taken back by the second iterate
  EXPECT_LT(maxDistance(three, afterSteps(50, true)), 1e-12);
  EXPECT_GT(maxDistance(two, afterSteps(1, false)), 0.001);
  for (std::size_t i = 0; i < 21; ++i) EXPECT_LT(two[i].x(), 0);
}

TEST(ContactStep, ConvergedMotionDoesNotDependOnIterations) {
  const auto afterSteps = [](int iterations) {
    const Groom groom = swatch();
    Settings settings = swatchSettings();
    settings.contacts.iterations = iterations;
    Simulation<double> simulation(groom, Material{}, settings);
    disturb(simulation, groom.firstPoint);
    simulateStill(simulation, 10 * settings.stepSeconds());
    return simulation.positions();
  };
  EXPECT_LT(maxDistance(afterSteps(1000), afterSteps(2000)), 1e-9);
}

// Strands that no pair of the rest pose's graph joins do not touch.
TEST(ContactStep, PrunedPairsPassThroughEachOther) {
  const Groom groom = swatch();
  Settings settings = swatchSettings();
  const auto contactsOf = [&](double dropShare) {
    settings.contacts.dropShare = dropShare;
    settings.contacts.prunePairs = true;
    Simulation<double> simulation(groom, Material{}, settings);
    disturb(simulation, groom.firstPoint);
    simulateStill(simulation, settings.stepSeconds());
    for (const Contact<double>& contact : simulation.contacts().live) {
      EXPECT_TRUE(
          simulation.contacts().rest.mayTouch(simulation.contacts().particles[contact.pair.a].strand,
                                              simulation.contacts().particles[contact.pair.b].strand));
    }
    return simulation.report().contacts;
  };
  const auto all = contactsOf(0), some = contactsOf(0.5);
  EXPECT_LT(some, all);
  EXPECT_GT(some, 0u);
  EXPECT_EQ(contactsOf(1), 0u);
}

TEST(ContactStep, FloatFollowsDouble) {
  const Groom groom = swatch();
  Settings settings = swatchSettings();
  Simulation<double> exact(groom, Material{}, settings);
  Simulation<float> single(groom, Material{}, settings);
  const Motion shake = *motionByName("shake", {0, 1, 0});
  simulate(exact, 0.5, [&](double t) { return shake.poseAt(t); });
  simulate(single, 0.5, [&](double t) { return shake.poseAt(t); });
  EXPECT_GT(exact.report().contacts, 20u);
  // No looser than without contacts: rounding does not decide who touches.
  EXPECT_LT(maxDistance(single.positions(), exact.positions()), 5e-6);
}

// ---- two curls, brought from 6 cm between their axes to 1 cm and apart again

struct Meeting {
  int crossings = 0;
  double deepest = 0;            // overlap beyond rest, share of R
  double creep = 0;              // fastest particle over the last 0.5 s of being pressed [m/s]
  std::vector<double> energies;  // kinetic, after every step [J]
};

/// `handedness` of the second curl. Closest from 1.25 s to 2.5 s; apart again, and the roots at rest, from
/// 3.25 s on.
Meeting meetTwoCurls(const Settings& settings, double bendStiffness, double handedness, double seconds) {
  Groom groom;
  groom.metresPerUnit = 1;
  const double from = 0.06, nearest = 0.01;
  for (const int side : {-1, 1}) {
    std::vector<Vec3f> points = Helix{}.points();
    // The first particles lie in front of one core and behind the other: roots do not run into each other.
    for (Vec3f& p : points) {
      const Vec3f q = p;
      p = {static_cast<float>(side) * q.z + static_cast<float>(side * from / 2), q.y,
           static_cast<float>(-side) * q.x};
      if (side > 0 && handedness < 0) p.x = static_cast<float>(from) - p.x;
    }
    groom.addStrand(points);
  }
  Material material;
  material.bendStiffness = bendStiffness;
  Simulation<double> simulation(groom, material, settings);
  Settings on = settings;
  on.contacts.on = true;
  on.contacts.method = ContactMethod::explicitPairs;
  const auto particles = Simulation<double>(groom, material, on).contacts().particles;

  Meeting meeting;
  Field<double> pressed;
  simulation.setRootShifts(std::vector<Vec3d>{{(from - nearest) / 2, 0, 0}, {(nearest - from) / 2, 0, 0}});
  const double T = settings.stepSeconds();
  for (int n = 1; n * T < seconds + T / 2; ++n) {
    const double t = n * T, shift = ease((t - 0.5) / 0.75) - ease((t - 2.5) / 0.75);
    const Field<double> before = simulation.positions();
    const HeadPose pose{{}, {}, shift};
    simulation.stepFrame(std::span(&pose, 1));
    meeting.crossings += crossingCount(groom.firstPoint, before, simulation.positions());
    meeting.deepest = std::max(meeting.deepest, deepestOverlap(particles, simulation.positions()));
    double energy = 0;
    for (std::size_t i = 0; i < groom.points.size(); ++i) {
      energy += simulation.restStrands()[0].masses[i % 64] / 2 * simulation.velocities()[i].squaredNorm();
    }
    meeting.energies.push_back(energy);
    if (std::abs(t - 2) < T / 2) pressed = simulation.positions();
    if (std::abs(t - 2.5) < T / 2) meeting.creep = maxDistance(simulation.positions(), pressed) / 0.5;
  }
  EXPECT_EQ(simulation.report().nonfinite, 0u);
  return meeting;
}

TEST(TwoCurls, NeverPassThroughEachOther) {
  for (const double bendStiffness : {1.0, 2.0, 5.0}) {
    for (const double handedness : {1.0, -1.0}) {
      const Meeting meeting = meetTwoCurls(meetingSettings(0.005), bendStiffness, handedness, 4);
      EXPECT_EQ(meeting.crossings, 0) << bendStiffness << " w, " << handedness;
      EXPECT_LT(meeting.deepest, 0.3) << bendStiffness << " w, " << handedness;
    }
  }
}

TEST(TwoCurls, WithoutContactsTheyDo) {
  Settings settings = meetingSettings(0.005);
  settings.contacts.on = false;
  for (const double bendStiffness : {1.0, 5.0}) {
    const Meeting meeting = meetTwoCurls(settings, bendStiffness, 1, 4);
    EXPECT_GT(meeting.crossings, 5) << bendStiffness;
    EXPECT_GT(meeting.deepest, 0.8) << bendStiffness;
  }
}

TEST(TwoCurls, CalmDownPressedAndApart) {
  const Meeting meeting = meetTwoCurls(meetingSettings(0.005), 5, 1, 6);
  const double peak = *std::ranges::max_element(meeting.energies);
  const auto energyAt = [&](double t) { return meeting.energies[static_cast<std::size_t>(t * 192) - 1]; };
  EXPECT_LT(energyAt(2.5), 1e-3 * peak);
  EXPECT_LT(energyAt(6), 1e-6 * peak);
  // Whole periods of 0.25 s, so that a swing does not matter.
  for (double t = 3.5; t + 0.5 <= 6; t += 0.25) {
    const auto greatest = [&](double from) {
      const auto first = meeting.energies.begin() + static_cast<std::ptrdiff_t>(from * 192);
      return *std::max_element(first, first + 48);
    };
    EXPECT_LT(greatest(t + 0.25), greatest(t));
  }
  EXPECT_LT(meeting.creep, 0.002);
}

}  // namespace
}  // namespace ringlet::reference::test::contact_step_test
