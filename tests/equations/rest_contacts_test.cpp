// Tests reference/rest_contacts.h: radii, contact particles and which strands may touch, against closed
// forms.
#include "reference/rest_contacts.h"

#include <gtest/gtest.h>

#include "tests/equations/strand_fixtures.h"

namespace ringlet::reference::test::rest_contacts_test {
namespace {

/// Straight strands that hang from the given roots, of equal edges [m].
std::vector<RestStrand<double>> hanging(const std::vector<Vec3d>& roots, double edge, int particleCount) {
  std::vector<RestStrand<double>> strands;
  for (const Vec3d& root : roots) {
    std::vector<Vec3f> points;
    for (int i = 0; i < particleCount; ++i)
      points.push_back(static_cast<Vec3f>(root + Vec3d{0, -edge * i, 0}));
    strands.push_back(restOf(points));
  }
  return strands;
}

std::vector<Vec3d> row(int count, double spacing) {
  std::vector<Vec3d> roots;
  for (int k = 0; k < count; ++k) roots.push_back({spacing * k, 0, 0});
  return roots;
}

constexpr double kFloat = 1e-7;  // points are rounded to float, as the solver stores them

TEST(RestContacts, RadiusIsTheSettingOrHalfTheSpacingOfRoots) {
  ContactSettings settings;
  EXPECT_NEAR(makeRestContacts(hanging(row(5, 0.02), 0.004, 20), settings).radii[3], 0.01, kFloat);
  settings.radius = 0.003;
  EXPECT_EQ(makeRestContacts(hanging(row(5, 0.02), 0.004, 20), settings).radii[3], 0.003);
}

TEST(RestContacts, WithoutSpacingOfRootsItIsHalfTheMeanEdge) {
  const ContactSettings settings;
  EXPECT_NEAR(makeRestContacts(hanging(row(1, 0), 0.004, 20), settings).radii[0], 0.002, kFloat);
  EXPECT_NEAR(makeRestContacts(hanging(row(3, 0), 0.004, 20), settings).radii[2], 0.002, kFloat);
}

TEST(RestContacts, KeepsParticlesASpacingApart) {
  ContactSettings settings;
  settings.radius = 0.01;
  // 0.75 R is 15 mm: every fourth edge of 4 mm.
  EXPECT_EQ(makeRestContacts(hanging(row(1, 0), 0.004, 20), settings).particles[0],
            (std::vector<std::uint32_t>{0, 4, 8, 12, 16}));
  settings.spacing = 0.1;
  EXPECT_EQ(makeRestContacts(hanging(row(1, 0), 0.004, 20), settings).particles[0].size(), 20u);
}

// Edges of 0.6 R: one is less than 0.75 R, two are more than R and would leave a gap.
TEST(RestContacts, NeverSkipsFurtherThanR) {
  ContactSettings settings;
  settings.radius = 0.005;
  const RestContacts rest = makeRestContacts(hanging(row(1, 0), 0.006, 20), settings);
  EXPECT_EQ(rest.particles[0].size(), 19u);  // the tip is nearer than the spacing to the one before
  EXPECT_EQ(rest.radii[0], 0.005);
}

TEST(RestContacts, CoarseStrandsGetALargerRadius) {
  ContactSettings settings;
  settings.radius = 0.002;
  settings.fillGaps = true;
  auto strands = hanging(row(2, 0.05), 0.006, 20);
  strands[1] = hanging(row(1, 0), 0.003, 20)[0];
  const RestContacts rest = makeRestContacts(strands, settings);
  EXPECT_NEAR(rest.radii[0], 0.003, kFloat);
  EXPECT_EQ(rest.radii[1], 0.002);
  EXPECT_EQ(rest.particles[0].size(), 20u);
}

// On curls and random walks too, whatever the radius.
TEST(RestContacts, SpheresLeaveNoGap) {
  std::mt19937 random(5);
  for (const double radius : {0.0005, 0.004, 0.02}) {
    for (const double spacing : {0.3, 0.75, 1.0}) {
      std::vector<Vec3f> points = Helix{}.points();
      for (Vec3f& p : points)
        p += Vec3f(Vec3d{randomVector(random, 0.003).x(), 0, randomVector(random, 0.003).x()});
      ContactSettings settings;
      settings.radius = radius;
      settings.fillGaps = true;
      settings.spacing = spacing;
      const RestStrand<double> strand = restOf(points);
      const RestContacts rest = makeRestContacts(std::vector{strand}, settings);
      const std::vector<std::uint32_t>& kept = rest.particles[0];
      for (std::size_t k = 0; k + 1 < kept.size(); ++k) {
        const double apart = (strand.points[kept[k + 1]] - strand.points[kept[k]]).norm();
        EXPECT_LE(apart, 2 * rest.radii[0]);
        // Closer than the spacing only where the next would have been too far.
        if (apart < spacing * 2 * rest.radii[0]) {
          EXPECT_GT((strand.points[kept[k + 1] + 1] - strand.points[kept[k]]).norm(), 2 * rest.radii[0]);
        }
      }
    }
  }
}

TEST(RestContacts, ContactParticlesCarryTheStrandsMass) {
  ContactSettings settings;
  settings.radius = 0.01;
  const auto strands = hanging(row(1, 0), 0.004, 20);
  const double mass = Material{}.lineDensity * 0.004 * 19;
  EXPECT_NEAR(makeRestContacts(strands, settings).masses[0], mass / 5, 1e-6 * mass);
}

// A bunch, and one strand far from it: one in two of the 20 of the bunch, twice to the power 0.2 as large,
// four times as heavy; begun at the first or the second.
TEST(RestContacts, DenseStrandsAreThinned) {
  ContactSettings settings;
  settings.radius = 0.002;
  std::vector<Vec3d> roots = row(30, 0.0005);
  roots.push_back({1, 0, 0});
  const auto strands = hanging(roots, 0.004, 20);
  const RestContacts all = makeRestContacts(strands, settings);
  settings.detail = 0.5;
  const RestContacts thinned = makeRestContacts(strands, settings);
  int first = 0;
  for (std::size_t s = 0; s < 30; ++s) {
    ASSERT_EQ(thinned.particles[s].size(), 10u);
    for (std::size_t k = 0; k < 10; ++k) EXPECT_EQ(thinned.particles[s][k], thinned.particles[s][0] + 2 * k);
    first += thinned.particles[s][0] == 0;
    EXPECT_NEAR(thinned.radii[s] / all.radii[s], 1.1487, 1e-4);
    EXPECT_NEAR(thinned.masses[s] / all.masses[s], 4, 1e-12);
  }
  EXPECT_GT(first, 5);
  EXPECT_LT(first, 25);
  EXPECT_EQ(thinned.particles[30], all.particles[30]);
  EXPECT_EQ(thinned.radii[30], all.radii[30]);
  EXPECT_EQ(thinned.masses[30], all.masses[30]);
}

// Parallel strands D apart, particles h apart, all contact particles: |i - j| <= sqrt((e R)^2 - D^2) / h.
TEST(RestContacts, CountsOverlapsOfEnlargedSpheres) {
  ContactSettings settings;
  settings.radius = 0.004;
  settings.spacing = 0.5;
  const double h = 0.005, D = 0.007;
  const auto strands = hanging(row(2, D), h, 10);
  std::vector<Field<double>> points{strands[0].points, strands[1].points};
  const RestContacts rest = makeRestContacts(strands, settings);
  ASSERT_EQ(rest.particles[0].size(), 10u);
  EXPECT_EQ(overlapCounts(points, rest, 1.0)[0][1], 10);           // 8 mm: only those opposite
  EXPECT_EQ(overlapCounts(points, rest, 1.5)[0][1], 10 + 2 * 9);   // 12 mm: 9.7 mm along, one further
  EXPECT_EQ(overlapCounts(points, rest, 1.6)[1][0], 10 + 2 * 17);  // 12.8 mm: 10.7 mm, two further
}

TEST(RestContacts, DropsPairsOfStrandsThatBarelyOverlap) {
  ContactSettings settings;  // in a row, a root spacing R apart
  settings.prunePairs = true;
  settings.minOverlaps = 5;
  const auto strands = hanging(row(6, 0.01), 0.01, 10);
  // 15 mm reach the next strand (D = R, and one along), not the one after.
  const RestContacts next = makeRestContacts(strands, settings);
  for (std::uint32_t s = 0; s < 6; ++s) {
    for (std::uint32_t t = 0; t < 6; ++t) EXPECT_EQ(next.mayTouch(s, t), s + 1 == t || t + 1 == s);
  }
  settings.minOverlaps = 29;  // they have 10 + 2 x 9
  EXPECT_FALSE(makeRestContacts(strands, settings).mayTouch(0, 1));
  settings.prunePairs = false;
  const RestContacts all = makeRestContacts(strands, settings);
  EXPECT_TRUE(all.mayTouch(0, 5));
  EXPECT_FALSE(all.mayTouch(2, 2));
}

// A hundred strands at random, all near all: bounds, symmetry and shares of the random choice.
class PrunedNeighbours : public ::testing::Test {
 protected:
  static constexpr std::uint32_t kCount = 100;
  std::vector<std::vector<int>> counts = randomCounts();

  static std::vector<std::vector<int>> randomCounts() {
    std::mt19937 random(2);
    std::uniform_int_distribution<int> count(0, 20);
    std::vector counts(kCount, std::vector<int>(kCount, 0));
    for (std::uint32_t s = 0; s < kCount; ++s) {
      for (std::uint32_t t = 0; t < s; ++t) counts[s][t] = counts[t][s] = count(random);
    }
    return counts;
  }
  // Ends of all pairs; fails unless both directions are there, ascending.
  std::size_t entryCount(const std::vector<std::vector<std::uint32_t>>& neighbours) {
    std::size_t entries = 0;
    for (std::uint32_t s = 0; s < kCount; ++s) {
      EXPECT_TRUE(std::ranges::is_sorted(neighbours[s]));
      for (const std::uint32_t t : neighbours[s]) {
        EXPECT_TRUE(std::ranges::binary_search(neighbours[t], s));
        EXPECT_NE(s, t);
        ++entries;
      }
    }
    return entries;
  }
};

TEST_F(PrunedNeighbours, TheThresholdDecides) {
  ContactSettings settings;
  std::size_t expected = 0;
  for (const auto& strand : counts)
    expected += static_cast<std::size_t>(std::ranges::count_if(strand, [](int n) { return n >= 8; }));
  EXPECT_EQ(entryCount(prunedNeighbours(counts, settings)), expected);
}

TEST_F(PrunedNeighbours, NoStrandHasMoreThanTheBound) {
  ContactSettings settings;
  settings.maxNeighbours = 6;
  const auto neighbours = prunedNeighbours(counts, settings);
  entryCount(neighbours);
  for (std::uint32_t s = 0; s < kCount; ++s) {
    EXPECT_LE(neighbours[s].size(), 6u);
    for (const std::uint32_t t : neighbours[s]) {
      EXPECT_LT(std::ranges::count_if(counts[s], [&](int n) { return n > counts[s][t]; }), 6);
    }
  }
}

TEST_F(PrunedNeighbours, DropsAShareAtRandom) {
  ContactSettings settings;
  const std::size_t all = entryCount(prunedNeighbours(counts, settings));
  settings.dropShare = 0.5;
  const auto half = prunedNeighbours(counts, settings);
  // Some 3,000 pairs: a standard deviation is 0.9 % of them.
  EXPECT_NEAR(static_cast<double>(entryCount(half)) / static_cast<double>(all), 0.5, 0.04);
  EXPECT_EQ(prunedNeighbours(counts, settings), half);
  settings.seed = 2;
  EXPECT_NE(prunedNeighbours(counts, settings), half);
  settings.dropShare = 1;
  EXPECT_EQ(entryCount(prunedNeighbours(counts, settings)), 0u);
}

}  // namespace
}  // namespace ringlet::reference::test::rest_contacts_test
