// Tests reference/rest_strand.h: constants per edge from their formulas, masses, and balance of the rest
// pose.
#include "reference/rest_strand.h"

#include <gtest/gtest.h>

#include "tests/equations/strand_fixtures.h"

namespace ringlet::reference::test::rest_strand_test {
namespace {

constexpr double kFloatPoints =
    1e-6;  // points are rounded to float: lengths are good to about 1e-7 of themselves

TEST(RestStrand, ConstantsOfAStraightStrandFollowTheFormulas) {
  const Material material;
  Settings settings;
  settings.stepsPerFrame =
      64;  // short enough that bend damping is compensated, not halved, and the core not capped
  const RestStrand<double> rest = restOf(straightStrand({0.2, 0, 0}, 21), settings, material);
  const double S = 0.2, l = 0.01, lambda = material.lineDensity, w = lambda * 9.81 * S, T = 1.0 / (24 * 64);
  const double alpha = 0.02;  // a tenth of the strand
  EXPECT_NEAR(rest.arcLength, S, kFloatPoints * S);
  EXPECT_NEAR(rest.bendSmoothingLength, alpha, kFloatPoints);
  EXPECT_NEAR(rest.coreSmoothingLength, alpha, kFloatPoints);
  EXPECT_NEAR(rest.bendSmoothingShare, 1 - std::exp(-0.5), kFloatPoints);
  const double B = 2 * alpha * 5 * w, kb = B * std::tanh(0.25) / (l * l),
               cb = 0.15 * S * std::sqrt(5 * w * lambda) / l;
  const double kc = 40 * w / l, cc = 4 * 0.25 * alpha * std::sqrt(40 * w * lambda) / l;
  ASSERT_GT(cb - T * kb, cb / 2);
  for (std::size_t i = 0; i < rest.edgeCount(); ++i) {
    EXPECT_NEAR(rest.stretchStiffness[i] / (100 * w / l), 1, 1e-5);
    EXPECT_NEAR(rest.stretchDamping[i] / (w / l), 1, 1e-5);  // 0.01 s of 100 w
    EXPECT_NEAR(rest.bendStiffness[i] / kb, 1, 1e-5);
    EXPECT_NEAR(rest.bendDamping[i] / (cb - T * kb), 1, 1e-5);
    EXPECT_NEAR(rest.coreStiffness[i] / kc, 1, 1e-5);
    EXPECT_NEAR(rest.coreDamping[i] / cc, 1, 1e-5);
  }
  EXPECT_FALSE(rest.coreIsCapped);
}

TEST(RestStrand, WithoutSmoothingTheBendLawIsThatOfTheRule) {
  Material material;
  material.bendSmoothingLength = 0;
  material.coreSmoothingLength = 0;
  const RestStrand<double> rest = restOf(straightStrand({0.2, 0, 0}, 21), {}, material);
  const double w = material.lineDensity * 9.81 * 0.2, l = 0.01;
  EXPECT_EQ(rest.bendSmoothingShare, 1.0);
  EXPECT_NEAR(rest.bendStiffness[7] / (2 * 0.02 * 5 * w / (l * l)), 1, 1e-5);
}

TEST(RestStrand, SmoothingLengthFollowsTheCurl) {
  for (const double turns : {8.0, 24.0}) {
    const Helix helix{.turns = turns, .particleCount = static_cast<int>(24 * turns)};
    const double pitch = 0.25 / turns, around = 2 * kPi * 0.01, L = std::hypot(pitch, around);
    const double expected = L * std::max(0.5, std::sqrt(around / pitch / 0.3 - 1) / (2 * kPi));
    // The curl is measured on a polyline, 24 particles a turn.
    EXPECT_NEAR(restOf(helix.points()).bendSmoothingLength / expected, 1, 0.01) << turns;
  }
}

TEST(RestStrand, MassIsLineDensityTimesArcLength) {
  const Helix helix{.particleCount = 64};
  const RestStrand<double> rest = restOf(helix.points());
  double mass = 0;
  for (const double m : rest.masses) mass += m;
  const double S = std::hypot(helix.height, 2 * kPi * helix.radius * helix.turns);
  EXPECT_NEAR(mass / (Material{}.lineDensity * S), 1, 2e-3);  // arcs by circles through three points
  EXPECT_NEAR(mass, Material{}.lineDensity * rest.arcLength, 1e-15);
}

TEST(RestStrand, TheCoreIsCappedWhereTheStepIsTooLongForIt) {
  Material material;
  material.coreStiffness = 4000;
  Settings settings;
  settings.stepsPerFrame = 2;
  const RestStrand<double> rest = restOf(straightStrand({0.2, 0, 0}, 21), settings, material);
  const double T = 1.0 / 48, lambda = material.lineDensity, alpha = 0.02;
  const double highest = lambda * std::pow(4 * alpha / T, 2);
  ASSERT_LT(highest, 4000 * lambda * 9.81 * 0.2);
  EXPECT_TRUE(rest.coreIsCapped);
  EXPECT_NEAR(rest.coreStiffness[3] / (highest / 0.01), 1, 1e-5);
  EXPECT_NEAR(rest.coreDamping[3] / (alpha * std::sqrt(highest * lambda) / 0.01), 1, 1e-5);  // 4 zeta = 1
}

TEST(RestStrand, ThePaperUsesItsConstantsAndUnitMass) {
  Settings settings;
  settings.integrator = Integrator::paper;
  const RestStrand<double> rest = restOf(Helix{}.points(), settings);
  EXPECT_EQ(rest.stretchStiffness.front(), 5e5);
  EXPECT_EQ(rest.bendDamping.back(), 1.74e3);
  EXPECT_EQ(rest.coreStiffness.back(), 1.5e4);
  for (const double m : rest.masses) EXPECT_EQ(m, 1.0);
}

// One edge of length 0 and one tiny one: constants and limit use 1 % of the mean edge.
TEST(RestStrand, ShortEdgesAreFloored) {
  std::vector<Vec3f> points = straightStrand({0.2, 0, 0}, 21);
  points[5] = points[4];
  const RestStrand<double> rest = restOf(points);
  EXPECT_NEAR(rest.edgeLengths[4], 0.01 * rest.meanEdgeLength, 1e-15);
  EXPECT_NEAR(rest.stretchStiffness[4] / rest.stretchStiffness[10], 100, 1e-3);
  for (const Vector3<double>& target : rest.restTargets) EXPECT_TRUE(target.allFinite());
}

TEST(RestStrand, AStrandTooShortToHaveEdgesIsDerivedToo) {
  EXPECT_EQ(restOf({}).particleCount(), 0u);
  const RestStrand<double> single = restOf({{0.1f, 0, 0}});
  EXPECT_EQ(single.particleCount(), 1u);
  EXPECT_EQ(single.edgeCount(), 0u);
  EXPECT_EQ(restOf(straightStrand({0.2, 0, 0}, 2)).edgeCount(), 1u);
}

// Preload 0: no force anywhere. Preload 1: on every free particle the springs carry exactly its weight, for
// any integrator's masses and constants.
TEST(RestStrand, TheRestPoseIsBalanced) {
  for (const Integrator integrator : {Integrator::jacobi, Integrator::paper}) {
    for (const double preload : {0.0, 1.0}) {
      for (const int rootCount : {1, 3}) {
        Settings settings;
        settings.integrator = integrator;
        settings.gravityPreload = preload;
        settings.gravity = {3, -9.81, 1};
        settings.rootCount = rootCount;
        const Groom groom = groomOf(Helix{}.points());
        Simulation<double> simulation(groom, Material{}, settings);
        simulateStill(simulation, settings.stepSeconds());
        const StrandTaps<double>& taps = simulation.taps()[0];
        const RestStrand<double>& rest = simulation.restStrands()[0];
        double weight = 0;
        for (const double m : rest.masses) weight += m * 9.81;
        for (std::size_t i = 1; i < rest.particleCount(); ++i) {
          const Vector3<double> carried = preload * rest.masses[i] * Vector3<double>(3, -9.81, 1);
          // Rounding of forces that cancel: up to the strand's weight, and k times an edge.
          const double scale = weight + rest.stretchStiffness[i - 1] * rest.edgeLengths[i - 1];
          EXPECT_LT((particleForce(taps, i) + carried).norm(), 1e-13 * scale) << i;
        }
      }
    }
  }
}

}  // namespace
}  // namespace ringlet::reference::test::rest_strand_test
