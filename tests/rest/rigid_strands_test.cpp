// Which strands are carried rigidly (rest/rigid_strands.h): the bound on rounding against rounding itself,
// the rule on grooms that differ in what it asks, and what a person is told.
#include "ringlet/rest/rigid_strands.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "ringlet/rest/rest_state.h"
#include "tests/rest/contact_samples.h"

namespace ringlet::rigid_strands_test {
namespace {

using namespace test;

// Straight strands of `length` [m] in 16 particles, their roots `away` [m] from the origin, in all
// directions.
void addAround(Groom& groom, int count, double length, double away, unsigned seed, double offset = 0) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    return normalizedOr(Vec3d{normal(random), normal(random), normal(random)}, Vec3d{1, 0, 0});
  };
  for (int s = 0; s < count; ++s) {
    const Vec3d root = direction() * away + Vec3d{offset, 0, 0};
    groom.addStrand(line(root, root + direction() * length, 16));
  }
}

std::vector<std::uint32_t> rigidOf(const RestState& rest) {
  std::vector<std::uint32_t> strands;
  for (const RigidStrand& strand : rest.rigid) strands.push_back(strand.strandInGroom);
  return strands;
}

RestState stateOf(const Groom& groom, int stepsPerFrame = 8) {
  Settings settings;
  settings.stepsPerFrame = stepsPerFrame;
  auto rest = buildRestState(groom, {}, settings);
  EXPECT_TRUE(rest) << rest.error().message;
  return std::move(*rest);
}

int stepsOf(const Groom& groom) {
  const auto steps = chooseStepsPerFrame(groom, {}, {});
  EXPECT_TRUE(steps) << steps.error().message;
  return *steps;
}

bool tells(const RestState& rest, const std::string& part) {
  for (const std::string& warning : rest.warnings)
    if (warning.find(part) != std::string::npos) return true;
  return false;
}

// p + a, then + b, as a step moves both ends of an edge, in float and in double.
TEST(RigidStrands, RoundingOfAnEdgeIsWithinItsBound) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> side(-1, 1);
  double largest = 0;
  for (int trial = 0; trial < 200000; ++trial) {
    const double away = std::exp2(10 * side(random));
    const Vec3d about =
        normalizedOr(Vec3d{side(random), 0.1 * side(random), 0.01 * side(random)}, Vec3d{1, 0, 0}) * away;
    Vec3d off[2];
    for (Vec3d& end : off) {
      const auto start = static_cast<Vec3f>(about);
      const auto a = static_cast<Vec3f>(Vec3d{side(random), side(random), side(random)} * (1e-4 * away));
      const auto b = static_cast<Vec3f>(Vec3d{side(random), side(random), side(random)} * (1e-4 * away));
      const Vec3d exact = static_cast<Vec3d>(start) + static_cast<Vec3d>(a) + static_cast<Vec3d>(b);
      end = static_cast<Vec3d>((start + a) + b) - exact;
    }
    largest = std::max(largest, length(off[1] - off[0]) / edgeRounding(away * 1.001));
  }
  EXPECT_LE(largest, 1);
  EXPECT_GE(largest, 0.5) << "a bound far above what happens would carry too much";
}

TEST(RigidStrands, AreThoseThatFloatCannotHoldAndNoOthers) {
  Groom groom = metres(), without = metres();
  addAround(without, 60, 0.1, 1, 1);
  addAround(groom, 60, 0.1, 1, 1);
  for (double length : {1e-5, 1e-6, 1e-7, 1e-4}) addAround(groom, 1, length, 1, 7);
  const RestState rest = stateOf(groom);
  EXPECT_EQ(rigidOf(rest), (std::vector<std::uint32_t>{60, 61, 62, 63}));
  EXPECT_EQ(rest.strands.size(), 60u);
  EXPECT_EQ(rest.groomStrandCount, 64u);
  EXPECT_EQ(rest.groomParticleCount, 64u * 16);
  EXPECT_EQ(rest.rigid[1].firstInGroom, 61u * 16);
  EXPECT_EQ(rest.rigid[1].points.size(), 16u);
  EXPECT_TRUE(tells(rest, "4 of 64 strands are carried rigidly")) << rest.warnings.back();
  EXPECT_TRUE(tells(rest, "strands 60, 61, 62 and 63. Strand 62 has the finest")) << rest.warnings.back();
  EXPECT_EQ(stepsOf(groom), stepsOf(without));

  // The same strands at the origin have shapes that floats hold.
  Groom near = metres();
  addAround(near, 60, 0.1, 0, 1);
  addAround(near, 1, 1e-4, 0, 7);
  EXPECT_TRUE(stateOf(near).rigid.empty());
}

// A normal strand on which a file has two points in one place, or that is cut finely, is not for that
// carried.
TEST(RigidStrands, AreNotLongOnesOfFineEdges) {
  Groom groom = metres();
  addAround(groom, 20, 0.1, 1.7, 1);
  std::vector<Vec3f> doubled = line({0, 1.7, 0}, {0.1, 1.7, 0}, 16);
  doubled.insert(doubled.begin() + 3, doubled[3]);
  groom.addStrand(doubled);
  groom.addStrand(line({0, 1.7, 0}, {0.02, 1.7, 0}, 400));
  const RestState rest = stateOf(groom);
  EXPECT_TRUE(rest.rigid.empty());
  EXPECT_EQ(rest.strands.size(), 22u);
}

TEST(RigidStrands, AreAFewShortOnesThatNeedFarMoreSteps) {
  Groom normal = metres();
  addAround(normal, 300, 0.2, 0.1, 1);
  const auto withShort = [&](int count, double length) {
    Groom groom = normal;
    addAround(groom, count, length, 0.1, 2);
    return groom;
  };
  const int steps = stepsOf(normal);
  const Groom few = withShort(3, 0.0015);
  EXPECT_EQ(stepsOf(few), steps);
  const RestState rest = stateOf(few, steps);
  EXPECT_EQ(rigidOf(rest), (std::vector<std::uint32_t>{300, 301, 302}));
  EXPECT_TRUE(
      tells(rest, "3 of 303 strands are carried rigidly by the root, as so short strands need far more"));

  EXPECT_GT(stepsOf(withShort(4, 0.0015)), steps)
      << "more than one strand in a hundred: the groom takes the steps";
  EXPECT_TRUE(stateOf(withShort(4, 0.0015)).rigid.empty());
  EXPECT_TRUE(stateOf(few, 100).rigid.empty()) << "as many steps as they need";
  Groom longOnes = normal;  // tight curls as long as all others
  for (double x : {0.0, 0.02}) {
    std::vector<Vec3f> curl;
    for (int i = 0; i < 400; ++i)
      curl.push_back({static_cast<float>(x + 0.0005 * std::cos(i * 0.5)),
                      0.1f - 0.0005f * static_cast<float>(i),
                      static_cast<float>(0.0005 * std::sin(i * 0.5))});
    longOnes.addStrand(curl);
  }
  EXPECT_GT(stepsOf(longOnes), 2 * steps);
  EXPECT_TRUE(stateOf(longOnes).rigid.empty()) << "not short";
}

TEST(RigidStrands, OfAGroomFarFromItsOriginAreNoneUntilNoShapeIsLeft) {
  const auto groomAt = [](double offset) {
    Groom groom = metres();
    addAround(groom, 20, 0.1, 1, 1, offset);
    return stateOf(groom);
  };
  EXPECT_TRUE(groomAt(0).warnings.empty());
  const RestState at1km = groomAt(1e3), at1000km = groomAt(1e6);
  EXPECT_TRUE(at1km.rigid.empty());
  EXPECT_TRUE(tells(
      at1km, "the groom lies 1e+03 m from the head's origin, where float32 numbers are up to 0.00012 m"));
  EXPECT_EQ(at1000km.rigid.size(), 20u);
  EXPECT_TRUE(tells(at1000km, "the groom lies 1e+06 m from the head's origin"));
  EXPECT_TRUE(tells(at1000km, "move it to the origin, or check its unit"));
}

TEST(RigidStrands, CoordinatesBeyondAllSenseAreRefusedByNameAndValue) {
  const auto errorOf = [](Vec3f p, double metresPerUnit) {
    Groom groom = metres();
    addAround(groom, 3, 0.1, 1, 1);
    groom.points[20] = p;
    groom.metresPerUnit = metresPerUnit;
    const auto rest = buildRestState(groom, {}, {});
    return rest ? std::string() : rest.error().message;
  };
  const float most = std::numeric_limits<float>::max();
  EXPECT_EQ(errorOf({0, 1e30f, 0}, 1).find("strand 1 particle 4 is at (0, 1e+30, 0), 1e+30 m from"), 0u);
  EXPECT_EQ(errorOf({most, 0, 0}, 1000).find("strand 1 particle 4 is at (3.4028235e+38, 0, 0), 3.4e+41 m"),
            0u);
  EXPECT_EQ(errorOf({0, 0, 1.001e9f}, 1).find("strand 1 particle 4 is at"), 0u);
  EXPECT_EQ(errorOf({0, 0, 0.999e9f}, 1), "");
}

}  // namespace
}  // namespace ringlet::rigid_strands_test
