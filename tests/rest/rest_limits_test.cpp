// The limits of rest/rest_state.h: the longest step that needs no warning, the steps chosen by it and the
// load that is warned of. Each is compared with its formula.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "layout/strands.h"
#include "reference/step.h"
#include "ringlet/rest/rest_state.h"
#include "tests/rest/contact_samples.h"

namespace ringlet::rest_limits_test {
namespace {

using namespace test;

// A straight strand of S = 0.2 m, along X. Its smoothing length is a tenth of S.
Groom horizontal() {
  Groom groom = metres();
  groom.addStrand(line({}, {0.2, 0, 0}, 41));
  return groom;
}

// 3 alpha sqrt(lambda / (K_b w p)), w = lambda g S the weight and p the largest factor of the profile:
// bending is calm at most at this step [s]. Its edges' middles are where the profile is read.
double calmBendStep(const Material& material, double largestFactor) {
  const double S = 0.2, alpha = 0.1 * S;
  return 3 * alpha / std::sqrt(material.bendStiffness * kStandardGravity * S * largestFactor);
}

// Stiff in bending, so that bending and not the core decides.
Material stiffAt(double rootFactor, double tipFactor) {
  Material material;
  material.bendStiffness = 100;
  material.coreStiffness = 0.01;
  material.bendStiffnessProfile.points = {
      {0, rootFactor}, {0.1, rootFactor}, {0.9, tipFactor}, {1, tipFactor}};
  return material;
}

bool warnsOf(const RestState& rest, const std::string& part) {
  for (const std::string& warning : rest.warnings)
    if (warning.find(part) != std::string::npos) return true;
  return false;
}

TEST(RestLimits, TheStiffestEdgeDecidesTheLongestCalmStep) {
  const double ends[][2] = {{1, 1}, {4, 1}, {1, 4}, {9, 0.1}, {0.25, 0.25}};
  for (const auto& [root, tip] : ends) {
    const Material material = stiffAt(root, tip);
    const double calm = calmBendStep(material, std::max(root, tip));
    const auto rest = buildRestState(horizontal(), material, {});
    ASSERT_TRUE(rest) << rest.error().message;
    EXPECT_NEAR(rest->longestCalmStep, calm, 1e-6 * calm) << root << " at the root, " << tip << " at the tip";

    // Just longer is warned of, just shorter is not.
    Settings settings;
    settings.stepsPerFrame = 1;
    for (double share : {0.9999, 1.0001}) {
      settings.framesPerSecond = 1 / (calm * share);
      const auto built = buildRestState(horizontal(), material, settings);
      ASSERT_TRUE(built) << built.error().message;
      EXPECT_EQ(warnsOf(*built, "too few for the bending of 1 of 1 strands"), share > 1)
          << share << " of the calm step, " << root << " at the root, " << tip << " at the tip";
    }
  }
}

TEST(RestLimits, StepsAreChosenByTheStiffestEdge) {
  for (double factor : {1.0, 2.0, 4.0}) {
    const Material material = stiffAt(factor, 0.5);
    Settings settings;
    settings.framesPerSecond = 24;
    const auto steps = chooseStepsPerFrame(horizontal(), material, settings);
    ASSERT_TRUE(steps) << steps.error().message;
    const int needed = static_cast<int>(std::ceil(1 / (24 * calmBendStep(material, factor))));
    ASSERT_GT(needed, 8) << "more than the motion needs";
    ASSERT_LT(needed, 32) << "fewer than the most";
    EXPECT_EQ(*steps, needed) << "factor " << factor;
  }
}

// Each strand counts with its own stiffness.
TEST(RestLimits, TheStiffestOfStrandsThatVaryDecides) {
  Material material = stiffAt(1, 1);
  material.variation = {.bendStiffness = 0.5, .seed = 3};
  Groom groom = horizontal();
  for (int s = 1; s < 100; ++s) groom.addStrand(line({}, {0.2, 0, 0}, 41));
  double stiffest = 0;
  for (std::size_t s = 0; s < 100; ++s)
    stiffest = std::max(stiffest, materialOfStrand(material, s).bendStiffness / material.bendStiffness);
  ASSERT_GT(stiffest, 1.4);
  const double calm = calmBendStep(material, stiffest);
  const auto rest = buildRestState(groom, material, {});
  ASSERT_TRUE(rest) << rest.error().message;
  EXPECT_NEAR(rest->longestCalmStep, calm, 1e-6 * calm);
  EXPECT_EQ(*chooseStepsPerFrame(groom, material, {}), static_cast<int>(std::ceil(1 / (24 * calm))));
}

// Its constants are its own, profiles or not.
TEST(RestLimits, ThePaperKnowsNoProfiles) {
  Settings settings;
  settings.integrator = Integrator::paper;
  Material plain = stiffAt(1, 1);
  plain.bendStiffnessProfile = {};
  Material varying = stiffAt(4, 0.5);
  varying.lineDensityProfile = varying.bendStiffnessProfile;
  const auto a = buildRestState(horizontal(), plain, settings),
             b = buildRestState(horizontal(), varying, settings);
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->particles.size(), b->particles.size());
  for (std::size_t i = 0; i < a->particles.size(); ++i) {
    EXPECT_EQ(a->particles[i].bendFactor, b->particles[i].bendFactor) << "particle " << i;
    EXPECT_EQ(a->particles[i].mass, b->particles[i].mass) << "particle " << i;
  }
}

// An edge's load is what bends it, the preloaded weight beyond it across it, over its stiffness times its
// length: the tangent of the angle, 0.5 is 27 degrees. The reference has masses and stiffnesses of its own.
TEST(RestLimits, ALoadOfMoreThanAHalfIsWarnedOf) {
  const Groom groom = horizontal();
  Material material;
  material.bendStiffness = 0.3;
  material.bendStiffnessProfile.points = {{0, 2}, {1, 0.5}};
  material.lineDensityProfile.points = {{0, 1.5}, {1, 0.5}};
  Settings settings;
  settings.gravityPreload = 1;
  const reference::Simulation<double> reference(groom, material, settings);
  const auto& strand = reference.restStrands()[0];
  double largest = 0, massBeyond = 0;
  for (std::size_t i = strand.particleCount() - 1; i-- > 0;) {
    massBeyond += strand.masses[i + 1];
    const double load = -settings.gravity.y * massBeyond / (strand.bendStiffness[i] * strand.edgeLengths[i]);
    if (static_cast<int>(i) + 1 >= settings.rootCount) largest = std::max(largest, load);
  }
  ASSERT_GT(largest, 0.5);
  for (double share : {0.999, 1.001}) {
    settings.gravityPreload = share * 0.5 / largest;
    const auto rest = buildRestState(groom, material, settings);
    ASSERT_TRUE(rest) << rest.error().message;
    EXPECT_EQ(warnsOf(*rest, "27 degrees (strand 0 most: load 0.50)"), share > 1) << share;
  }
  EXPECT_NEAR(std::atan(0.5) * 180 / 3.14159265358979, 27, 0.5);
}

std::string errorOf(const Settings& settings) {
  const Status status = checkSettings(settings, {});
  return status ? "" : status.error().message;
}

// The taper in time is of pairs, and that method has none.
TEST(RestLimits, AVolumeAloneHasNoTaperInTime) {
  for (const ContactMethod method :
       {ContactMethod::automatic, ContactMethod::explicitPairs, ContactMethod::volume}) {
    for (const ContactTaper taper : {ContactTaper::distance, ContactTaper::time}) {
      for (const bool on : {false, true}) {
        Settings settings;
        settings.contacts.on = on;
        settings.contacts.method = method;
        settings.contacts.taper = taper;
        const bool isRefused = on && method == ContactMethod::volume && taper == ContactTaper::time;
        EXPECT_EQ(errorOf(settings).find("as a volume") != std::string::npos, isRefused) << nameOf(method);
      }
    }
  }
}

// The ends of every range are allowed, what lies just beyond is refused by name. Those of the air are in
// tests/kernels/rest_state_test.cpp.
template <class Number>
struct Range {
  const char* name;
  Number& (*of)(Settings&);
  Number low, high, below, above;
};

template <class Number>
void expectRange(const Range<Number>& range) {
  for (Number allowed : {range.low, range.high}) {
    Settings settings;
    range.of(settings) = allowed;
    EXPECT_EQ(errorOf(settings), "") << range.name << " " << allowed;
  }
  for (Number refused : {range.below, range.above}) {
    Settings settings;
    range.of(settings) = refused;
    EXPECT_EQ(errorOf(settings).find(std::string(range.name) + " is "), 0u) << range.name << " " << refused;
  }
}

using S = Settings;

void expectReal(const char* name, double& (*of)(S&), double low, double high) {
  expectRange<double>({name, of, low, high, std::nextafter(low, -1e9), std::nextafter(high, 1e9)});
  expectRange<double>({name, of, low, high, -INFINITY, NAN});
}
void expectWhole(const char* name, int& (*of)(S&), int low, int high) {
  expectRange<int>({name, of, low, high, low - 1, high + 1});
}

TEST(RestLimits, SettingsAreRefusedJustOutsideTheirRanges) {
  expectReal(
      "fps", [](S& s) -> double& { return s.framesPerSecond; }, 1e-3, 1e6);
  expectReal(
      "preload", [](S& s) -> double& { return s.gravityPreload; }, 0, 1);
  expectReal(
      "gravity.x", [](S& s) -> double& { return s.gravity.x; }, -1e4, 1e4);
  expectReal(
      "gravity.y", [](S& s) -> double& { return s.gravity.y; }, -1e4, 1e4);
  expectReal(
      "gravity.z", [](S& s) -> double& { return s.gravity.z; }, -1e4, 1e4);
  expectReal(
      "max_stretch", [](S& s) -> double& { return s.maxStretch; }, 1, 100);
  expectReal(
      "teleport_distance", [](S& s) -> double& { return s.teleportDistance; }, 0, 1e6);
  expectWhole(
      "steps_per_frame", [](S& s) -> int& { return s.stepsPerFrame; }, 1, 340);
  expectWhole(
      "roots", [](S& s) -> int& { return s.rootCount; }, 1, layout::kMaxRootCount);
  expectWhole(
      "iterations", [](S& s) -> int& { return s.pointIterations; }, 1, 60000);
  expectWhole(
      "force_loops", [](S& s) -> int& { return s.forceLoops; }, 1, 1000);
  expectWhole(
      "damping_loops", [](S& s) -> int& { return s.dampingLoops; }, 1, 1000);
}

TEST(RestLimits, SettingsOfContactsAreRefusedJustOutsideTheirRanges) {
  expectReal(
      "contacts.radius", [](S& s) -> double& { return s.contacts.radius.emplace(); }, 1e-6, 1);
  expectReal(
      "contacts.spacing", [](S& s) -> double& { return s.contacts.spacing; }, 0.01, 1);
  expectReal(
      "contacts.detail", [](S& s) -> double& { return s.contacts.detail; }, 0.05, 1);
  expectReal(
      "contacts.enlargement", [](S& s) -> double& { return s.contacts.enlargement; }, 1, 100);
  expectReal(
      "contacts.drop_share", [](S& s) -> double& { return s.contacts.dropShare; }, 0, 1);
  expectReal(
      "contacts.stiffness", [](S& s) -> double& { return s.contacts.stiffness; }, 0, 1e7);
  expectReal(
      "contacts.damping_ratio", [](S& s) -> double& { return s.contacts.dampingRatio; }, 0, 100);
  expectReal(
      "contacts.friction", [](S& s) -> double& { return s.contacts.friction; }, 0, 1);
  expectReal(
      "contacts.ramp_seconds", [](S& s) -> double& { return s.contacts.rampSeconds; }, 0, 10);
  expectReal(
      "contacts.stiffness_release_seconds",
      [](S& s) -> double& { return s.contacts.stiffnessReleaseSeconds; }, 0, 10);
  expectReal(
      "contacts.damping_release_seconds", [](S& s) -> double& { return s.contacts.dampingReleaseSeconds; }, 0,
      10);
  expectReal(
      "contacts.break_factor", [](S& s) -> double& { return s.contacts.breakFactor; }, 1, 10);
  expectWhole(
      "contacts.min_overlaps", [](S& s) -> int& { return s.contacts.minOverlaps; }, 1, 1000000);
  expectWhole(
      "contacts.max_neighbours", [](S& s) -> int& { return s.contacts.maxNeighbours; }, 0, 1000000);
  expectWhole(
      "contacts.iterations", [](S& s) -> int& { return s.contacts.iterations.emplace(); }, 1, 1000);
}

}  // namespace
}  // namespace ringlet::rest_limits_test
