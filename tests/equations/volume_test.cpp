// Hair as a volume, the reference by itself: what particles give each other sums to nothing, what the head
// carries rigidly feels nothing, the iteration converges whatever the stiffness, and the reference's own
// groups and densities against the host's. Mirrors reference/equations/volume.h and
// reference/kernels/volume_step.h.
#include "reference/equations/volume.h"

#include <gtest/gtest.h>

#include <random>

#include "reference/kernels/contact_step.h"
#include "reference/kernels/volume_step.h"
#include "ringlet/groom/generate.h"
#include "ringlet/rest/rest_volume.h"
#include "tests/equations/strand_fixtures.h"

namespace ringlet::reference::test::volume_test {
namespace {

// 60 particles in a ball of 4 cm, of two strands; a head that turns.
struct Ball {
  ContactSettings settings;
  Volume volume;
  Field<double> positions, velocities;
  VolumeFrame frame{Rotation<double>(Eigen::AngleAxisd(0.3, Vector3<double>::UnitX())),
                    Rotation<double>(Eigen::AngleAxisd(0.5, Vector3<double>(1, 2, 3).normalized())), 0.005};

  explicit Ball(double memory = 0.003) {
    std::mt19937 random(5);
    volume.cell = 0.01;
    for (std::uint32_t i = 0; i < 60; ++i) {
      positions.push_back(randomVector(random, 0.02));
      velocities.push_back(randomVector(random, 1));
      VolumeParticle p;
      p.first = i;
      p.mass = 1e-6 * (1 + 0.5 * randomVector(random, 1).x());
      p.density = p.restDensity = 3;
      p.ownDensity = 1 + 0.5 * randomVector(random, 1).y();
      p.memory = randomVector(random, memory);
      p.place = frame.now.conjugate() * positions[i];
      p.isKnown = true;
      volume.particles.push_back(p);
    }
    beginVolume(settings, frame, positions, velocities, {}, volume);
  }
  VolumeSystem means() {
    bringVolume(velocities, volume);
    return volumeMeans(settings, frame, positions, volume);
  }
};

TEST(Volume, MomentaSumToNothing) {
  Ball ball;
  const VolumeSystem system = ball.means();
  Vector3<double> sum = Vector3<double>::Zero();
  double size = 0;
  for (std::size_t i = 0; i < ball.positions.size(); ++i) {
    const Vector3<double> given = system.momenta[i] - system.weights[i] * ball.velocities[i];
    sum += given;
    size += given.norm();
  }
  EXPECT_GT(size, 1e-4);
  EXPECT_LT(sum.norm(), 1e-12 * size);
}

// A lock that turns and shears as one body: with the gradient of its own motion each particle is told just
// what it does itself, so that nothing is given; and the gradient is found again, but for the share that
// fades.
TEST(Volume, AnAffineMotionIsFree) {
  Ball ball(0);
  Matrix3<double> motion;
  motion << 1, -20, 3, 25, 2, -4, 5, 6, 7;
  for (std::size_t i = 0; i < ball.positions.size(); ++i)
    ball.velocities[i] = ball.frame.carried(ball.positions[i]) +
                         ball.frame.now * (motion * ball.volume.particles[i].gridPlace);
  const double kappa = ball.settings.volumeGain(ball.frame.seconds);
  for (VolumeParticle& p : ball.volume.particles) p.gradient = kappa * motion;
  const VolumeSystem system = ball.means();
  for (std::size_t i = 0; i < ball.positions.size(); ++i) {
    const VolumeParticle& p = ball.volume.particles[i];
    const Vector3<double> given = system.momenta[i] - system.weights[i] * ball.velocities[i];
    EXPECT_LT(given.norm(), 1e-12 * system.weights[i]);
    const Vector3<double> x = p.gridPlace / ball.volume.cell;
    const Vector3<double> inCell = x - x.array().floor().matrix();
    EXPECT_LT((p.gradient - keptGradient(kappa * motion, inCell)).norm(), 1e-9 * kappa);
  }
}

TEST(Volume, AGradientMovesNothingInSum) {
  Ball ball;
  ball.means();
  double size = 0;
  for (const VolumeParticle& p : ball.volume.particles) size = std::max(size, p.gradient.norm());
  EXPECT_GT(size, 1) << "no gradient, and nothing is tested";
  const VolumeSystem system = ball.means();
  Vector3<double> sum = Vector3<double>::Zero();
  for (std::size_t i = 0; i < ball.positions.size(); ++i)
    sum += system.momenta[i] - system.weights[i] * ball.velocities[i];
  EXPECT_LT(sum.norm(), 1e-12 * 1e-4);
}

// What a particle of the volume gets goes to those that it represents in equal parts; the momenta sum to
// nothing at their mean velocity. Those that have fallen get nothing.
TEST(Volume, ItsParticlesShareWhatTheyGet) {
  Ball ball;
  for (std::uint32_t k = 0; k < 20; ++k) {
    VolumeParticle& p = ball.volume.particles[k];
    p.first = 3 * k, p.count = p.present = 3;
  }
  ball.volume.particles.resize(20);
  ball.volume.release(29, 30);
  ball.volume.release(33, 36);
  EXPECT_EQ(ball.volume.particles[9].present, 2u);
  EXPECT_EQ(ball.volume.particles[11].mass, 0);
  ball.volume.forget();
  beginVolume(ball.settings, ball.frame, ball.positions, ball.velocities, {}, ball.volume);
  const VolumeSystem system = ball.means();
  Vector3<double> sum = Vector3<double>::Zero();
  double size = 0;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const bool isThere = i != 29 && (i < 33 || i > 35);
    EXPECT_EQ(system.weights[i] > 0, isThere) << i;
    if (i % 3 > 0 && isThere) {
      EXPECT_EQ(system.weights[i], system.weights[i - 1]) << i;
    }
    sum += system.momenta[i] - system.weights[i] * ball.velocities[i];
    size += system.momenta[i].norm();
  }
  EXPECT_LT(sum.norm(), 1e-12 * size);
}

TEST(Volume, WhatTheHeadCarriesFeelsNothing) {
  Ball ball(0);
  for (std::size_t i = 0; i < ball.positions.size(); ++i)
    ball.velocities[i] = ball.frame.carried(ball.positions[i]);
  const VolumeSystem system = ball.means();
  for (std::size_t i = 0; i < ball.positions.size(); ++i) {
    const Vector3<double> given = system.momenta[i] - system.weights[i] * ball.velocities[i];
    EXPECT_LT(given.norm(), 1e-12 * system.weights[i]);
    EXPECT_GT(system.weights[i], 0);
  }
}

// All in one place but one, displaced by d: k m o times what is left of d pulls it back, and nothing the
// others but what balances it.
TEST(Volume, ADisplacementIsPulledBack) {
  Ball ball(0);
  std::fill(ball.velocities.begin(), ball.velocities.end(), Vector3<double>::Zero());
  ball.frame.next = ball.frame.now;
  for (VolumeParticle& p : ball.volume.particles) p.place.setZero(), p.mass = 1e-6, p.ownDensity = 0;
  std::fill(ball.positions.begin(), ball.positions.end(), Vector3<double>::Zero());
  ball.volume.forget();
  beginVolume(ball.settings, ball.frame, ball.positions, ball.velocities, {}, ball.volume);
  ball.volume.particles[7].memory = {0.002, 0, 0};
  const VolumeSystem system = ball.means();
  const double T = ball.frame.seconds, k = ball.settings.volumeStiffness;
  const Vector3<double> wanted = ball.frame.now * Vector3<double>(-1e-6 * k * T * 0.002 * 59 / 60, 0, 0);
  EXPECT_LT((system.momenta[7] - wanted).norm(), 1e-12);
  EXPECT_LT((system.momenta[8] + wanted / 59).norm(), 1e-12);
}

TEST(Volume, AStrandByItselfFeelsNothing) {
  EXPECT_EQ(othersShare(2, 2), 0);
  EXPECT_EQ(othersShare(3, 2), 0);
  EXPECT_EQ(othersShare(0, 2), 1);
  EXPECT_DOUBLE_EQ(othersShare(0.5, 2), 0.75);
  EXPECT_EQ(othersShare(0, 0), 0);
}

// (m + g) v' = m v0 + what the others' means give: each iterate nearer to the last, at any stiffness.
TEST(Volume, IterationConvergesAtAnyStiffness) {
  for (const double stiffness : {0.0, 1e5, 1e9}) {
    Ball ball;
    ball.settings.volumeStiffness = stiffness;
    const Field<double> start = ball.velocities;
    double change = 0, last = 0;
    for (int iteration = 0; iteration < 400; ++iteration) {
      const VolumeSystem system = ball.means();
      change = 0;
      for (std::size_t i = 0; i < start.size(); ++i) {
        const double m = ball.volume.particles[i].mass;
        const Vector3<double> next = (m * start[i] + system.momenta[i]) / (m + system.weights[i]);
        change = std::max(change, (next - ball.velocities[i]).norm());
        ball.velocities[i] = next;
      }
      if (iteration > 5) {
        EXPECT_LT(change, 1.0001 * last + 1e-12) << stiffness;
      }
      last = change;
    }
    EXPECT_LT(change, 1e-2) << stiffness;
  }
}

// What sums have room for follows the settings: 32 m/s beside the head together with twice a strand's length,
// rounded up to a power of two.
TEST(Volume, RoomOfSumsFollowsTheSettings) {
  for (const double drag : {0.0, 600.0, 1e5}) {
    for (const double stiffness : {0.0, 1e5, 1e9}) {
      for (const double T : {1.0 / 24, 1.0 / 192, 1.0 / 1536}) {
        for (const double longest : {0.001, 0.56, 3.0}) {
          ContactSettings settings;
          settings.volumeDrag = drag, settings.volumeStiffness = stiffness;
          const double most = settings.volumeMostRate(T, longest);
          EXPECT_EQ(most, std::exp2(std::round(std::log2(most))));
          const Vector3<double> fastest =
              volumeRate(settings, T, Vector3<double>::Constant(32), Vector3<double>::Constant(2 * longest));
          EXPECT_GE(most, fastest.x());
          EXPECT_LT(most, std::max(2.0, 2 * fastest.x()));
        }
      }
    }
  }
  EXPECT_EQ(ContactSettings{}.volumeMostRate(1.0 / 192, 0.56), 8192);
}

// An error e of the mean that a step's guess has becomes, a step later, by the formulas of volume.glsl for a
// particle whose system is l m: smaller, at any gain, be the particle free or held fast.
TEST(Volume, AnErrorOfTheGuessDecays) {
  ContactSettings settings;
  settings.volumeDrag = 0;
  for (const double T : {1.0 / 96, 1.0 / 192, 1.0 / 768}) {
    for (const double kappa : {0.01, 1.0, 5.8, 100.0, 1e6}) {
      settings.volumeStiffness = kappa / (T * T);
      for (const double l : {1.0, 1.5, 10.0, 1e9}) {
        const double e = 1, m = 1, g = m * kappa;
        const double change = g * e / (l * m + g), given = g * (e - change);
        const double next = guessedChange(settings, T, {change, 0, 0}, Vector3<double>(given / m, 0, 0)).x();
        EXPECT_LE(std::abs(next), kVolumeMostWarmth * kappa / (2 + kappa) * (1 + 1e-9)) << kappa << ", " << l;
      }
    }
  }
}

// What all hair of a neighbourhood does meets the same resistance at any step for which a warmth from 0 to
// the most gives that.
TEST(Volume, TheResistanceDoesNotDependOnTheStep) {
  int free = 0;
  for (const double stiffness : {7e4, 1e6, 1e8}) {
    for (const double T : {1.0 / 48, 1.0 / 96, 1.0 / 192, 1.0 / 384, 1.0 / 768, 1.0 / 1e5}) {
      ContactSettings settings;
      settings.volumeStiffness = stiffness;
      const double kappa = settings.volumeGain(T), beta = settings.volumeWarmth(T);
      ASSERT_LE(beta, kVolumeMostWarmth);
      EXPECT_LE(std::abs(beta) * kappa / (2 + kappa), kVolumeMostWarmth * (1 + 1e-12));
      if (beta == kVolumeMostWarmth || T < 1e-4) continue;
      EXPECT_NEAR(kappa / (1 + kappa * (1 - beta)) / T, kVolumeResponse, 1e-6);
      ++free;
    }
  }
  EXPECT_GE(free, 12);
  ContactSettings nothing;
  nothing.volumeDrag = nothing.volumeStiffness = 0;
  EXPECT_EQ(nothing.volumeWarmth(0.005), 0);
}

// Hair that comes nearer from all sides is given no more of it; one direction gives its share to all three.
TEST(Volume, AGradientKeepsNoCompression) {
  Matrix3<double> gradient;
  gradient << -3, 1, 2, -1, 5, 0, 4, 0, -8;
  const Vector3<double> middle(0.5, 0.3, 0.7);
  const Matrix3<double> kept = keptGradient(gradient, middle) / kVolumeGradient;
  EXPECT_NEAR(kept.trace(), 0, 1e-12);
  EXPECT_NEAR(kept(0, 0), -1, 1e-12);
  EXPECT_EQ(kept(0, 1), 1);
  gradient(2, 2) = 8;
  EXPECT_LT((keptGradient(gradient, middle) - kVolumeGradient * gradient).norm(), 1e-12);
}

// The gradient jumps at faces of cells, and what a particle keeps does not.
TEST(Volume, AGradientEndsAtFaces) {
  Matrix3<double> gradient;
  gradient << 3, 1, 2, -1, 5, 0, 4, 0, 8;
  for (const double face : {0.0, 1.0}) {
    const Matrix3<double> kept = keptGradient(gradient, {0.5, face, 0.5}) / kVolumeGradient;
    EXPECT_EQ(kept.col(1).norm(), 0);
    EXPECT_LT((kept.col(0) - gradient.col(0)).norm(), 1e-12);
    const double beside = std::abs(face - 1e-6);
    EXPECT_LT(keptGradient(gradient, {0.5, beside, 0.5}).col(1).norm(), 1e-4);
  }
}

// Beside the guess nothing of the last step counts: what it gave is left out with its share, of hair that was
// not just put there and does not follow the head.
TEST(Volume, GuessesFromTheLastStep) {
  Ball ball;
  const Field<double> changes(ball.velocities.size(), Vector3<double>(0.1, 0, 0));
  ball.volume.particles[3].pinned = 1;
  const VolumeSystem system = ball.means();
  endVolume(system, ball.velocities, ball.volume);
  ball.volume.particles[5].isKnown = false;
  beginVolume(ball.settings, ball.frame, ball.positions, ball.velocities, changes, ball.volume);
  const double kappa = ball.settings.volumeGain(ball.frame.seconds);
  for (std::size_t i = 0; i < ball.volume.particles.size(); ++i) {
    const VolumeParticle& p = ball.volume.particles[i];
    Vector3<double> expected = ball.velocities[i];
    const Vector3<double> given = (system.momenta[i] - system.weights[i] * ball.velocities[i]) / p.mass;
    const double warmth = ball.settings.volumeWarmth(ball.frame.seconds);
    if (i != 5) expected += warmth * changes[i];
    if (i != 5 && i != 3) expected -= warmth * given / (2 + kappa);
    EXPECT_LT((p.velocity - expected).norm(), 1e-12) << i;
  }
}

TEST(Volume, ADisplacementFades) {
  ContactSettings settings;
  Vector3<double> s(1, 0, 0);
  for (int step = 0; step < 300; ++step) s = fadedDisplacement(settings, 0.001, s, Vector3<double>::Zero());
  EXPECT_NEAR(s.x(), std::exp(-1.0), 1e-12);
  EXPECT_NEAR(fadedDisplacement(settings, 1e-9, s, {0, 2, 0}).y(), 2, 1e-6);
}

// A head whose strands grow denser to one side, and a second one beside it: strands in the volume, their
// groups and the densities of their particles are the host's.
// Two heads beside each other, of 150 and of 40 strands.
Groom twoHeads() {
  HeadParameters head;
  head.curl.particleCount = 24;
  head.strandCount = 150;
  Groom groom = *makeHead(head);
  head.strandCount = 40;
  const Groom other = *makeHead(head);
  for (std::size_t s = 0; s < other.strandCount(); ++s) {
    std::vector<Vec3f> points;
    for (const Vec3f p : other.strand(s))
      points.push_back(p + Vec3f{1.5f / static_cast<float>(groom.metresPerUnit), 0, 0});
    groom.addStrand(points);
  }
  for (int k = 0; k < 6; ++k) {  // beside the first head: in its cells, but not dense
    std::vector<Vec3f> points;
    for (const Vec3f p : other.strand(0))
      points.push_back(p + Vec3f{0.02f + 0.04f * float(k), 0.01f, 0} * float(1 / groom.metresPerUnit));
    groom.addStrand(points);
  }
  return groom;
}

void expectSameVolume(const RestVolume& volume, const ringlet::RestState& state,
                      const Contacts<double>& contacts, std::size_t particleCount) {
  ASSERT_EQ(volume.firsts.size(), contacts.volume.particles.size());
  EXPECT_NEAR(volume.cell, contacts.volume.cell, 1e-6 * volume.cell);
  std::vector<const VolumeParticle*> byFirst(particleCount);
  for (const VolumeParticle& p : contacts.volume.particles) byFirst[p.first] = &p;
  for (std::size_t i = 0; i < volume.firsts.size(); ++i) {
    const std::uint32_t strand = volume.strands[i];
    const VolumeParticle* p =
        byFirst[state.firstInGroom[strand] + volume.firsts[i] - state.strands[strand].firstParticle];
    ASSERT_NE(p, nullptr);
    EXPECT_EQ(volume.counts[i], p->count);
    EXPECT_NEAR(volume.densities[i], p->restDensity, 1e-5 * p->restDensity);
    EXPECT_NEAR(volume.ownDensities[i], p->ownDensity, 1e-5 * p->ownDensity);
    EXPECT_NEAR(volume.masses[i], p->mass, 1e-5 * p->mass);
  }
}

TEST(Volume, GroupsAndDensitiesAreTheHosts) {
  const Groom groom = twoHeads();
  // Of the dense strands and of the others; the first strand of the groom is in one.
  const auto bundles = std::make_shared<const std::vector<ContactBundle>>(
      std::vector<ContactBundle>{{0, 5, 7, 190}, {2, 3, 191}});
  for (const auto& [method, bundled] : {std::pair{ContactMethod::automatic, false},
                                        {ContactMethod::explicitPairs, false},
                                        {ContactMethod::volume, false},
                                        {ContactMethod::automatic, true},
                                        {ContactMethod::explicitPairs, true},
                                        {ContactMethod::volume, true}}) {
    Settings settings;
    if (bundled) settings.contacts.bundles = bundles;
    settings.contacts.on = true;
    settings.contacts.method = method;
    settings.contacts.radius = 0.01;
    settings.contacts.prunePairs = true;
    settings.contacts.enlargement = 1.2;
    const auto state = buildRestState(groom, {}, settings);
    ASSERT_TRUE(state) << state.error().message;
    const ringlet::RestContacts host = buildRestContacts(*state, settings.contacts);
    std::vector<RestStrand<double>> strands;
    for (std::size_t s = 0; s < groom.strandCount(); ++s)
      strands.push_back(makeRestStrand<double>(groom.strand(s), groom.metresPerUnit, {}, {}, settings));
    const auto contacts = makeContacts<double>(strands, groom.firstPoint, settings.contacts);

    std::size_t count = 0;
    const auto groupOf = [&, areBundled = bundled](std::size_t s) {  // as the host names them
      if (areBundled && contacts.rest.bundles[s] != RestContacts::kNoGroup)
        return 1000 + contacts.rest.bundles[s];
      return contacts.rest.isInVolume(s) ? contacts.rest.volumeGroups[s] : static_cast<std::uint32_t>(s);
    };
    for (std::size_t a = 0; a < strands.size(); ++a) {
      const std::size_t inGroomA = state->strandInGroom[a];
      EXPECT_EQ(host.volume.isIn[a], contacts.rest.isInVolume(inGroomA)) << a;
      count += host.volume.isIn[a];
      for (std::size_t b = 0; b < a; ++b) {
        EXPECT_EQ(host.volume.groups[a] == host.volume.groups[b],
                  groupOf(inGroomA) == groupOf(state->strandInGroom[b]))
            << a << ", " << b;
        EXPECT_EQ(host.volume.inOneBundle(a, b),
                  groupOf(inGroomA) >= 1000 && groupOf(inGroomA) == groupOf(state->strandInGroom[b]));
      }
    }
    EXPECT_EQ(host.volume.count, count);
    if (method == ContactMethod::automatic) {
      EXPECT_GT(count, 20u);
      EXPECT_LT(count, 196u);
    } else {
      EXPECT_EQ(count, method == ContactMethod::volume ? (bundled ? 189u : 196u) : 0u);
    }

    expectSameVolume(buildRestVolume(*state, host), *state, contacts, groom.points.size());
  }
}

}  // namespace
}  // namespace ringlet::reference::test::volume_test
