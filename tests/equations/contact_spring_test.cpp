// Tests reference/equations/contact_spring.h.
#include "reference/equations/contact_spring.h"

#include <gtest/gtest.h>

#include "tests/equations/strand_fixtures.h"

namespace ringlet::reference::test::contact_spring_test {
namespace {

constexpr double kStep = 0.005;      // T [s]: a quarter of the default ramp and releases
constexpr double kMass = 2e-6;       // m_c [kg]
constexpr double kRadiusSum = 0.01;  // R [m]

struct Pair {
  Vector3<double> xa, xb, va, vb;
  Pair swapped() const { return {xb, xa, vb, va}; }
};

/// A step of a pair, seen from its first particle: all the equations in a row.
struct PairStep {
  ContactPlace<double> place;
  bool touching = false;
  ContactLife<double> life;
  ContactWeights<double> weights;
  Vector3<double> impulse;  // on the first particle, at the velocities given [kg m/s]

  PairStep(const ContactSettings& settings, const ContactConstants<double>& constants, const Pair& pair,
           ContactLife<double> before, bool firstIsLower, double T = kStep)
      : place(contactPlace<double>(pair.xa - pair.xb, pair.va - pair.vb, firstIsLower)),
        touching(isTouching(place, constants.restLength, T)),
        life(nextLife(settings, before, touching, place.distance, constants.restLength, T)),
        weights(contactWeights(settings, constants, life, !before.isOver(), touching, place.distance, T)),
        impulse(weights.push * place.normal - contactMatrix(weights, place.normal) * (pair.va - pair.vb)) {}
};

ContactConstants<double> constantsOf(const ContactSettings& settings) {
  return contactConstants<double>(settings, kMass, kRadiusSum, 1.0);
}

// Two particles `distance` apart that part at `separation`, with something across it.
Pair pairAt(double distance, double separation) {
  const Vector3<double> normal(0.6, 0, 0.8), across(0.8, 0, -0.6);
  return {normal * distance, Vector3<double>::Zero(), separation * normal + 0.3 * across,
          Vector3<double>::Zero()};
}

TEST(ContactSpring, ConstantsFollowWeightAndSize) {
  const ContactSettings settings;
  const ContactConstants<double> constants = constantsOf(settings);
  // A thousand times its weight over R: pressed by its own weight, a particle sinks in by a thousandth.
  EXPECT_NEAR(constants.stiffness * kRadiusSum / 1000, kMass * 9.81, 1e-18);
  EXPECT_NEAR(constants.damping * constants.damping, 4 * constants.stiffness * kMass, 1e-18);
  EXPECT_EQ(constants.restLength, kRadiusSum);
  EXPECT_EQ(contactConstants<double>(settings, kMass, kRadiusSum, 0.003).restLength,
            0.003 - kContactSlack * kRadiusSum);
  EXPECT_EQ(contactConstants<double>(settings, kMass, kRadiusSum, 0).restLength, 0);
}

TEST(ContactSpring, BothSidesAreEqualAndOpposite) {
  std::mt19937 random(3);
  ContactSettings settings;
  settings.friction = 0.4;
  const ContactConstants<double> constants = constantsOf(settings);
  for (int trial = 0; trial < 200; ++trial) {
    const Pair pair{randomVector(random, 0.006), randomVector(random, 0.006), randomVector(random, 1),
                    randomVector(random, 1)};
    const ContactLife<double> before{randomVector(random, 1).norm() / 2, 1};
    const PairStep one(settings, constants, pair, before, true),
        other(settings, constants, pair.swapped(), before, false);
    EXPECT_EQ(one.touching, other.touching);
    EXPECT_EQ(one.weights.push, other.weights.push);
    EXPECT_LE((one.impulse + other.impulse).norm(), 1e-15 * one.impulse.norm());
  }
}

TEST(ContactSpring, ParticlesInOnePlacePartByTheirIndex) {
  const ContactSettings settings;
  const Vector3<double> place(0.1, 0.2, 0.3), up(0, 1, 0), none = Vector3<double>::Zero();
  for (const double distance : {0.0, 1e-14}) {
    const Pair pair{place + distance * Vector3<double>(1, 0, 0), place, none, none};
    const PairStep lower(settings, constantsOf(settings), pair, {}, true),
        higher(settings, constantsOf(settings), pair.swapped(), {}, false);
    EXPECT_EQ(lower.place.normal, up);
    EXPECT_EQ(higher.place.normal, -up);
    EXPECT_GT(lower.impulse.y(), 0);
    EXPECT_EQ(lower.impulse, -higher.impulse);
  }
}

TEST(ContactSpring, AtRestThereIsNoContact) {
  const ContactSettings settings;
  const auto constants = contactConstants<double>(settings, kMass, kRadiusSum, 0.004);
  // Nor where rounding is against it.
  const Pair pair{{0.004 - 5e-7, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  EXPECT_FALSE(PairStep(settings, constants, pair, {}, true).touching);
  EXPECT_TRUE(PairStep(settings, constants, pair, {}, true).life.isOver());
}

// Just inside, after a step of approach at u: the spring's force is k (T / ramp) u T and vanishes with T^2,
// so that all that begins at once is damping.
TEST(ContactSpring, FirstContactBeginsWithDampingAlone) {
  const ContactSettings settings;
  const ContactConstants<double> constants = constantsOf(settings);
  const double u = 0.5;
  for (const double T : {1e-3, 5e-4, 2.5e-4, 1e-6}) {
    const PairStep step(settings, constants, pairAt(kRadiusSum - u * T, -u), {}, true, T);
    const double damping = constants.damping * u;
    const double spring = step.weights.push / T;  // [N]
    EXPECT_NEAR(spring, constants.stiffness * (T / settings.rampSeconds) * u * T, 1e-12 * damping);
    const double force = step.impulse.dot(step.place.normal) / T;
    EXPECT_LE(force, damping * (1 + 4 * T / settings.rampSeconds));
    EXPECT_GE(force, damping);
  }
}

TEST(ContactSpring, SeesAheadWithoutDamping) {
  const ContactSettings settings;
  const ContactConstants<double> constants = constantsOf(settings);
  // 1 mm away at 0.5 m/s: 2.5 mm in a step.
  const PairStep ahead(settings, constants, pairAt(0.011, -0.5), {}, true);
  EXPECT_TRUE(ahead.touching);
  EXPECT_EQ(ahead.weights.normal(), kStep * kStep * constants.stiffness * ahead.life.stiffnessShare);
  EXPECT_LT(ahead.weights.push, 0);
  // Approach ends at r0: the rate at which the impulse is zero.
  const double rate = -0.001 / kStep;
  EXPECT_NEAR(ahead.weights.push - ahead.weights.normal() * rate, 0, 1e-20);
  // Slower than the gap allows, or parting, it is no contact.
  EXPECT_TRUE(PairStep(settings, constants, pairAt(0.011, -0.19), {}, true).life.isOver());
  EXPECT_TRUE(PairStep(settings, constants, pairAt(0.011, 0.5), {}, true).life.isOver());
}

// What rests comes to r0: nothing may hang on which side of it rounding finds it.
TEST(ContactSpring, AnOldContactIsTheSameOnBothSidesOfItsRestLength) {
  ContactSettings settings;
  settings.friction = 0.3;
  const ContactConstants<double> constants = constantsOf(settings);
  const PairStep inside(settings, constants, pairAt(kRadiusSum * (1 - 1e-9), -0.01), {1, 1}, true),
      outside(settings, constants, pairAt(kRadiusSum * (1 + 1e-9), -0.01), {1, 1}, true);
  EXPECT_TRUE(inside.touching);
  EXPECT_TRUE(outside.touching);
  // All that differs is how far the spring is pressed.
  const double pressed = 2e-9 * kRadiusSum * kStep * constants.stiffness;
  EXPECT_NEAR((inside.impulse - outside.impulse).norm(), pressed, 1e-6 * pressed);
  // Parting, both lose their spring and keep their damper.
  EXPECT_FALSE(inside.weights.isMet(0.01));
  EXPECT_FALSE(outside.weights.isMet(0.01));
  EXPECT_EQ(inside.weights.damping, outside.weights.damping);
  EXPECT_TRUE(inside.weights.isMet(-0.01));
  EXPECT_TRUE(outside.weights.isMet(-0.01));
}

TEST(ContactSpring, EngagesBreaksAndEngagesAgain) {
  const ContactSettings settings;  // 20 ms each: four steps
  const double r0 = kRadiusSum, inside = 0.9 * r0, outside = 1.1 * r0;
  ContactLife<double> life;
  const auto step = [&](bool touching, double distance) {
    life = nextLife(settings, life, touching, distance, r0, kStep);
    return std::array{life.stiffnessShare, life.dampingShare};
  };
  using Shares = std::array<double, 2>;
  for (const double kappa : {0.25, 0.5, 0.75, 1.0, 1.0}) EXPECT_EQ(step(true, inside), (Shares{kappa, 1}));
  for (const double kappa : {0.75, 0.5}) EXPECT_EQ(step(false, outside), (Shares{kappa, 1}));
  EXPECT_EQ(step(true, inside), (Shares{0.75, 1}));  // from where it was
  for (const double kappa : {0.5, 0.25, 0.0}) EXPECT_EQ(step(false, outside), (Shares{kappa, 1}));
  for (const double delta : {0.75, 0.5}) EXPECT_EQ(step(false, outside), (Shares{0, delta}));
  EXPECT_EQ(step(true, outside), (Shares{0.25, 1}));  // the damping comes back at once
  EXPECT_EQ(step(false, outside), (Shares{0, 1}));
  for (const double delta : {0.75, 0.5, 0.25}) EXPECT_EQ(step(false, outside), (Shares{0, delta}));
  EXPECT_FALSE(life.isOver());
  EXPECT_EQ(step(false, outside), (Shares{0, 0}));
  EXPECT_TRUE(life.isOver());
}

// Damping fades from the rest length to its end; the spring acts while the two touch, and nothing is
// remembered.
TEST(ContactSpring, TheDistanceTaperFollowsThePlace) {
  const double r0 = kRadiusSum, end = kContactTaperEnd * r0;
  for (const double inside : {0.0, 0.5 * r0, r0}) EXPECT_EQ(lifeAt(true, inside, r0).dampingShare, 1);
  EXPECT_EQ(lifeAt(true, 0.5 * r0, r0).stiffnessShare, 1);
  EXPECT_EQ(lifeAt(false, 0.5 * (r0 + end), r0).stiffnessShare, 0);
  EXPECT_NEAR(lifeAt(false, 0.5 * (r0 + end), r0).dampingShare, 0.5, 1e-12);
  EXPECT_NEAR(lifeAt(false, 0.25 * r0 + 0.75 * end, r0).dampingShare, 0.25, 1e-12);
  EXPECT_TRUE(lifeAt(false, end, r0).isOver());
  EXPECT_TRUE(lifeAt(false, 2 * r0, r0).isOver());
  // Seen ahead from beyond its end: the spring alone.
  EXPECT_EQ(lifeAt(true, 1.5 * r0, r0).stiffnessShare, 1);
  EXPECT_EQ(lifeAt(true, 1.5 * r0, r0).dampingShare, 0);
  EXPECT_TRUE(lifeAt(false, 0.0, 0.0).isOver()) << "two that were in one place at rest never touch";
}

TEST(ContactSpring, IsGoneBeyondTheBreakDistanceUnlessItComesBack) {
  const ContactSettings settings;
  const double beyond = 1.21 * kRadiusSum;
  EXPECT_FALSE(nextLife<double>(settings, {1, 1}, false, 1.19 * kRadiusSum, kRadiusSum, kStep).isOver());
  EXPECT_TRUE(nextLife<double>(settings, {1, 1}, false, beyond, kRadiusSum, kStep).isOver());
  EXPECT_EQ(nextLife<double>(settings, {1, 1}, true, beyond, kRadiusSum, kStep).stiffnessShare, 1);
}

TEST(ContactSpring, TimesOfZeroAreSteps) {
  ContactSettings settings;
  settings.rampSeconds = settings.stiffnessReleaseSeconds = settings.dampingReleaseSeconds = 0;
  const double outside = 1.1 * kRadiusSum;
  ContactLife<double> life = nextLife<double>(settings, {}, true, 0.9 * kRadiusSum, kRadiusSum, kStep);
  EXPECT_EQ(life.stiffnessShare, 1);
  life = nextLife(settings, life, false, outside, kRadiusSum, kStep);
  EXPECT_EQ(life.stiffnessShare, 0);
  EXPECT_EQ(life.dampingShare, 1);
  EXPECT_TRUE(nextLife(settings, life, false, outside, kRadiusSum, kStep).isOver());
}

// While breaking there is no spring to pull; the damper slows the parting, by its share.
TEST(ContactSpring, BreakingOnlyDamps) {
  const ContactSettings settings;
  const ContactConstants<double> constants = constantsOf(settings);
  const PairStep full(settings, constants, pairAt(0.011, 0.2), {1, 1}, true);
  EXPECT_FALSE(full.touching);
  EXPECT_EQ(full.weights.push, 0);
  EXPECT_EQ(full.weights.normal(), kStep * constants.damping);
  const PairStep half(settings, constants, pairAt(0.011, 0.2), {0, 0.75}, true);
  EXPECT_EQ(half.weights.normal(), 0.5 * kStep * constants.damping);
}

TEST(ContactSpring, FrictionDampsAcrossTheNormalOnly) {
  ContactSettings settings;
  const ContactConstants<double> constants = constantsOf(settings);
  const Pair pair = pairAt(0.009, 0);
  const Vector3<double> normal(0.6, 0, 0.8), across(0.8, 0, -0.6);
  EXPECT_NEAR(PairStep(settings, constants, pair, {1, 1}, true).impulse.dot(across), 0, 1e-20);
  settings.friction = 0.25;
  const PairStep rubbing(settings, constants, pair, {1, 1}, true);
  EXPECT_NEAR(rubbing.impulse.dot(across), -kStep * 0.25 * constants.damping * 0.3, 1e-18);
  const Matrix3<double> q = contactMatrix(rubbing.weights, normal);
  EXPECT_LT((q * normal - rubbing.weights.normal() * normal).norm(), 1e-18);
  EXPECT_LT((q * across - rubbing.weights.tangential * across).norm(), 1e-18);
}

// push is T times the force, minus the slope of k kappa / 2 (r0 - d)^2; and T^2 k kappa is T^2 times the
// force's own slope along n, so that push - q_n u_n is the force at the end of the step.
TEST(ContactSpring, PushAndWeightAreTheSpringsSlopes) {
  std::mt19937 random(8);
  ContactSettings settings;
  settings.dampingRatio = 0;
  const ContactConstants<double> constants = constantsOf(settings);
  const double k = constants.stiffness, r0 = constants.restLength, h = 1e-7;
  for (int trial = 0; trial < 50; ++trial) {
    const Vector3<double> xa = randomVector(random, 1).normalized() * 0.008, none = Vector3<double>::Zero();
    const Vector3<double> va = randomVector(random, 0.2);
    const PairStep step(settings, constants, {xa, none, va, none}, {1, 1}, true);
    const auto energy = [&](const Vector3<double>& x) { return k / 2 * (r0 - x.norm()) * (r0 - x.norm()); };
    const auto force = [&](const Vector3<double>& x) { return k * (r0 - x.norm()); };
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3<double> shift = h * Vector3<double>::Unit(axis);
      const double slope = (energy(xa + shift) - energy(xa - shift)) / (2 * h);
      EXPECT_NEAR(step.weights.push * step.place.normal[axis], -kStep * slope, 1e-7 * kStep * k * r0);
    }
    const Vector3<double> shift = h * step.place.normal;
    const double slope = (force(xa + shift) - force(xa - shift)) / (2 * h);
    EXPECT_NEAR(step.weights.normal(), -kStep * kStep * slope, 1e-7 * kStep * kStep * k);
    const double forceAtEnd = force(xa + kStep * va.dot(step.place.normal) * step.place.normal);
    EXPECT_NEAR(step.impulse.dot(step.place.normal), kStep * forceAtEnd, 1e-12 * kStep * k * r0);
  }
}

}  // namespace
}  // namespace ringlet::reference::test::contact_spring_test
