// The solver's rest state against the reference's own: two derivations of the same laws, so that a fault in
// one shows.
#include "ringlet/rest/rest_state.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "layout/strands.h"
#include "reference/step.h"
#include "ringlet/groom/groom_file.h"
#include "tests/support/parity.h"
#include "tests/support/test_support.h"
#include "tests/support/tolerances.h"
#include "tests/support/varying_curls.h"

namespace ringlet::test::rest_state_test {
namespace {

void expectNear(double found, double expected, const std::string& what) {
  EXPECT_NEAR(found, expected, kRestState * std::max(std::abs(expected), 1e-9)) << what;
}

void expectSameRest(const Groom& groom, const Settings& settings, const Material& material = {}) {
  const auto rest = buildRestState(groom, material, settings);
  ASSERT_TRUE(rest) << rest.error().message;
  const reference::Simulation<double> reference(groom, material, settings);
  ASSERT_EQ(rest->strands.size(), groom.strandCount());
  for (std::size_t d = 0; d < rest->strands.size(); ++d) {
    const layout::StrandRest& strand = rest->strands[d];
    const std::size_t s = rest->strandInGroom[d];
    const auto& expected = reference.restStrands()[s];
    const std::string label = "strand " + std::to_string(s);
    const double unit = strand.massUnit;  // kg per mass unit
    ASSERT_EQ(strand.particleCount, expected.particleCount());
    EXPECT_EQ(rest->firstInGroom[d], groom.firstPoint[s]);
    expectNear(strand.bendBeta, expected.bendSmoothingShare, label + " bendBeta");
    expectNear(strand.coreBeta, expected.coreSmoothingShare, label + " coreBeta");
    expectNear(strand.restCoreLength, expected.coreLength, label + " restCoreLength");
    for (std::size_t i = 0; i < expected.particleCount(); ++i) {
      const layout::ParticleRest& particle = rest->particles[strand.firstParticle + i];
      const std::string at = label + " particle " + std::to_string(i);
      expectNear(particle.mass * unit, expected.masses[i], at + " mass");
      if (i + 1 == expected.particleCount()) continue;
      const bool paper = settings.integrator == Integrator::paper;
      const double l = expected.edgeLengths[i], scale = paper ? 1 : unit / particle.edgeLength;
      EdgeFactors f{{1, particle.bendFactor, 1}, 1, std::sqrt(particle.bendFactor), 1, {}};
      if (!rest->edgeFactors.empty()) f = rest->edgeFactors[strand.firstParticle + i];
      EXPECT_EQ(f.stiffness.y, particle.bendFactor) << at;
      expectNear(particle.edgeLength, l, at + " edgeLength");
      expectNear(particle.coreEdgeLength, expected.coreRestLengths[i], at + " coreEdgeLength");
      expectNear(strand.stretchStiffness * scale * f.stiffness.x, expected.stretchStiffness[i],
                 at + " stretchStiffness");
      expectNear(strand.stretchDamping * scale * f.stretchDamping, expected.stretchDamping[i],
                 at + " stretchDamping");
      const double bend = strand.bendStiffness * scale * particle.bendFactor;
      expectNear(bend, expected.bendStiffness[i], at + " bendStiffness");
      const double damping = strand.bendDamping * scale * f.bendDamping;
      const double compensated = std::max(damping - settings.stepSeconds() * bend, damping / 2);
      expectNear(paper ? damping : compensated, expected.bendDamping[i], at + " bendDamping");
      expectNear(strand.coreStiffness * scale * f.stiffness.z, expected.coreStiffness[i],
                 at + " coreStiffness");
      expectNear(strand.coreDamping * scale * f.coreDamping, expected.coreDamping[i], at + " coreDamping");
      expectNear(particle.stretchRestLength, expected.stretchRestLengths[i], at + " stretch rest length");
      const Eigen::Vector3d target(particle.target.x, particle.target.y, particle.target.z);
      EXPECT_LE((target - expected.restTargets[i]).norm(),
                kRestState * std::max(l, expected.restTargets[i].norm()))
          << at << " target";
    }
  }
}

Settings settingsWith(Integrator integrator, double preload, int steps) {
  Settings settings;
  settings.integrator = integrator;
  settings.gravityPreload = preload;
  settings.stepsPerFrame = steps;
  return settings;
}

TEST(RestState, AgreesWithTheReferenceOnCurlsThatVary) {
  for (int steps : {4, 32}) {
    expectSameRest(varyingGroom(64), settingsWith(Integrator::jacobi, 1, steps));
    expectSameRest(varyingGroom(200), settingsWith(Integrator::jacobi, 0, steps));
  }
}

TEST(RestState, AgreesWithTheReferenceOnGeneratedGrooms) {
  const Groom groom = randomGroom({2, 3, 31, 100, 128, 64, 17, 300}, 5);
  for (double preload : {0.0, 0.6, 1.0}) {
    for (int steps : {4, 32}) {  // 4 caps the core spring of some
      expectSameRest(groom, settingsWith(Integrator::jacobi, preload, steps));
      expectSameRest(groom, settingsWith(Integrator::paper, preload, steps));
      expectSameRest(groom, settingsWith(Integrator::jacobi, preload, steps), varyingMaterial());
    }
  }
}

TEST(RestState, AgreesWithTheReferenceOnARealGroom) {
  RINGLET_NEEDS_DATA(path, "curlycue/frame_000.obj");
  const auto loaded = readGroom(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  expectSameRest(loaded->groom, settingsWith(Integrator::jacobi, 1, 8));
}

// Bit by bit, whatever the settings; and what is known is taken, not measured again.
TEST(RestState, GeometryThatIsKnownGivesTheSameBits) {
  Groom groom = varyingGroom(64);
  const Vec3f root = groom.strand(0).front();
  std::vector<Vec3f> tooFine(12, root);  // is carried rigidly
  for (std::size_t i = 0; i < tooFine.size(); ++i) tooFine[i].x += 1e-7f * static_cast<float>(i);
  groom.addStrand(tooFine);
  const auto known = measureGeometry(groom);
  ASSERT_TRUE(known) << known.error().message;
  ASSERT_EQ(known->size(), groom.strandCount());

  const auto sameBits = [](const auto& a, const auto& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
  };
  Material profiled;
  profiled.bendStiffnessProfile.points = {{0, 2}, {1, 0.5}};
  for (const Material& material : {Material{}, profiled}) {
    for (const int steps : {2, 8}) {
      Settings settings;
      settings.stepsPerFrame = steps;
      const auto measured = buildRestState(groom, material, settings);
      const auto given = buildRestState(groom, material, settings, {}, *known);
      ASSERT_TRUE(measured && given);
      EXPECT_FALSE(measured->rigid.empty());
      EXPECT_TRUE(sameBits(measured->strands, given->strands));
      EXPECT_TRUE(sameBits(measured->particles, given->particles));
      EXPECT_EQ(measured->warnings, given->warnings);
      EXPECT_EQ(*chooseStepsPerFrame(groom, material, settings),
                *chooseStepsPerFrame(groom, material, settings, *known));
    }
  }
  auto other = *known;
  for (StrandGeometry& strand : other) strand.smoothingLength *= 2;
  EXPECT_NE(buildRestState(groom, {}, {}, {}, other)->strands[0].bendBeta,
            buildRestState(groom, {}, {})->strands[0].bendBeta);
}

// The stiffest part of a strand decides: nine times as stiff a core takes three times the steps.
TEST(RestState, StepsAreChosenByTheStiffestCore) {
  Groom curl;
  curl.metresPerUnit = 1;
  for (int i = 0; i < 128; ++i) {
    const float turn = 0.4f * static_cast<float>(i);
    curl.points.push_back(
        {0.006f * std::cos(turn), -0.002f * static_cast<float>(i), 0.006f * std::sin(turn)});
  }
  curl.firstPoint = {0, 128};
  Material material;
  material.coreStiffness = 150;
  const int plain = *chooseStepsPerFrame(curl, material, {});
  for (const double most : {9.0, 1 / 9.0}) {
    material.coreStiffnessProfile.points = {{0, std::min(most, 1.0)}, {0.5, most}, {1, std::min(most, 1.0)}};
    const int steps = *chooseStepsPerFrame(curl, material, {});
    EXPECT_NEAR(steps, most > 1 ? 3 * plain : 8, 2) << plain;
    Settings settings;
    settings.stepsPerFrame = steps;
    EXPECT_TRUE(buildRestState(curl, material, settings)->warnings.empty());
  }
}

TEST(RestState, StepsAreChosenByTheMotionAndTheGroom) {
  Groom curl;
  curl.metresPerUnit = 1;
  curl.addStrand(helix(64, 0.01, 0.25, 8, 0, 1));
  Groom withShort = curl;
  withShort.addStrand(helix(16, 0.0003, 0.004, 3, 0, 1));
  const auto chosen = [](const Groom& groom, double fps, Integrator integrator) {
    Settings settings = settingsWith(integrator, 1, 1);
    settings.framesPerSecond = fps;
    const auto steps = chooseStepsPerFrame(groom, {}, settings);
    EXPECT_TRUE(steps) << steps.error().message;
    settings.stepsPerFrame = *steps;
    EXPECT_TRUE(buildRestState(groom, {}, settings)->warnings.empty()) << *steps << " steps";
    return *steps;
  };
  EXPECT_EQ(chosen(curl, 24, Integrator::jacobi), 8);
  EXPECT_EQ(chosen(curl, 60, Integrator::jacobi), 4);  // 192 / 60, rounded up
  EXPECT_GT(chosen(withShort, 24, Integrator::jacobi), 8);

  // Fewer than it needs: a warning with the number that is enough.
  const auto rest = buildRestState(withShort, {}, settingsWith(Integrator::jacobi, 1, 4));
  ASSERT_FALSE(rest->warnings.empty());
  const int enough = chosen(withShort, 24, Integrator::jacobi);
  EXPECT_NE(rest->warnings[0].find(std::to_string(enough) + " steps per frame give it in full"),
            std::string::npos)
      << rest->warnings[0];
  Material loose;
  loose.bendDampingRatio = 0.05;
  const auto undamped = buildRestState(curl, loose, settingsWith(Integrator::jacobi, 1, 8));
  ASSERT_EQ(undamped->warnings.size(), 1u);
  EXPECT_NE(undamped->warnings[0].find("0.05"), std::string::npos);
}

TEST(RestState, RefusesWhatItCannotHold) {
  const auto errorOf = [](const Groom& groom, const Settings& settings) {
    const auto rest = buildRestState(groom, {}, settings);
    return rest ? std::string() : rest.error().message;
  };
  const Groom good = randomGroom({8}, 1);
  EXPECT_EQ(errorOf(good, {}), "");
  EXPECT_NE(errorOf(Groom{}, {}).find("no strands"), std::string::npos);
  Groom broken = good;
  broken.points[3].y = NAN;
  EXPECT_NE(errorOf(broken, {}).find("strand 0 particle 3 is not finite"), std::string::npos);
  Groom point = good;
  for (Vec3f& p : point.points) p = {1, 2, 3};
  EXPECT_NE(errorOf(point, {}).find("length"), std::string::npos);
  Settings settings;
  settings.stepsPerFrame = 100000;
  EXPECT_NE(errorOf(good, settings).find("steps_per_frame is 100000; it must be from 1 to 340"),
            std::string::npos);
  settings = {};
  settings.maxStretch = NAN;
  EXPECT_NE(errorOf(good, settings).find("max_stretch"), std::string::npos);
  settings = {};
  settings.contacts.spacing = 1.5;  // strands would slip between the spheres
  EXPECT_NE(errorOf(good, settings).find("contacts.spacing is 1.5; it must be from 0.01 to 1"),
            std::string::npos);
  settings.contacts = {};
  settings.contacts.radius = -0.01;
  EXPECT_NE(errorOf(good, settings).find("contacts.radius is -0.01"), std::string::npos);
  settings.contacts = {};
  settings.contacts.on = true;
  EXPECT_EQ(errorOf(good, settings), "");
  settings.integrator = Integrator::pointJacobi;
  EXPECT_NE(errorOf(good, settings).find("point_jacobi; contacts need jacobi"), std::string::npos);
}

TEST(RestState, RefusesAirOutOfRange) {
  const Groom groom = randomGroom({8}, 1);
  const auto errorOf = [&](const Settings& settings) {
    const auto rest = buildRestState(groom, {}, settings);
    return rest ? std::string() : rest.error().message;
  };
  struct Range {
    const char* name;
    double& (*valueOf)(AirSettings&);
    double low, high;
  };
  const Range ranges[] = {
      {"air.fall_speed", [](AirSettings& air) -> double& { return air.fallSpeed; }, 0.01, 1000},
      {"air.along_share", [](AirSettings& air) -> double& { return air.alongShare; }, 0, 1},
      {"air.wind.x", [](AirSettings& air) -> double& { return air.wind.x; }, -1000, 1000},
      {"air.wind.y", [](AirSettings& air) -> double& { return air.wind.y; }, -1000, 1000},
      {"air.wind.z", [](AirSettings& air) -> double& { return air.wind.z; }, -1000, 1000},
      {"air.gust", [](AirSettings& air) -> double& { return air.gust; }, 0, 10},
      {"air.gust_seconds", [](AirSettings& air) -> double& { return air.gustSeconds; }, 0.01, 1000},
      {"air.turbulence", [](AirSettings& air) -> double& { return air.turbulence; }, 0, 1000},
      {"air.eddy_size", [](AirSettings& air) -> double& { return air.eddySize; }, 0.001, 1000},
  };
  for (const Range& range : ranges) {
    Settings settings;
    double& value = range.valueOf(settings.air);
    for (const double allowed : {range.low, range.high}) {
      value = allowed;
      EXPECT_EQ(errorOf(settings), "") << range.name << " " << allowed;
    }
    for (const double refused :
         {std::nextafter(range.low, -1e4), std::nextafter(range.high, 1e4), double(NAN), double(INFINITY)}) {
      value = refused;
      const std::string message = errorOf(settings);
      EXPECT_EQ(message.find(std::string(range.name) + " is "), 0u) << message;
      EXPECT_NE(message.find("it must be from"), std::string::npos) << message;
    }
  }
  Settings settings;
  settings.air.on = true;
  EXPECT_EQ(errorOf(settings), "");
  settings.integrator = Integrator::pointJacobi;
  EXPECT_NE(errorOf(settings).find("point_jacobi; air needs jacobi"), std::string::npos);
  settings.integrator = Integrator::paper;
  EXPECT_NE(errorOf(settings).find("the integrator paper; air needs jacobi"), std::string::npos);
}

}  // namespace
}  // namespace ringlet::test::rest_state_test
