// rest/contact_particles.h: radii, the pruning along a strand, masses.
#include "ringlet/rest/contact_particles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>

#include "tests/rest/contact_samples.h"

namespace ringlet::contact_particles_test {
namespace {

using namespace test;

double apart(Vec3f a, Vec3f b) { return length(static_cast<Vec3d>(a) - static_cast<Vec3d>(b)); }

ContactSettings withRadius(std::optional<double> radius) {
  ContactSettings settings;
  settings.radius = radius;
  settings.fillGaps = true;
  return settings;
}

// A strand along X with particles at these places [mm].
ContactParticles chosenAlong(const std::vector<double>& places, double radiusMm) {
  Groom groom = metres();
  std::vector<Vec3f> strand;
  for (double x : places) strand.push_back(static_cast<Vec3f>(Vec3d{1e-3 * x, 0, 0}));
  groom.addStrand(strand);
  return chooseContactParticles(restOf(groom), withRadius(1e-3 * radiusMm));
}

std::vector<double> every(double spacing, int count) {
  std::vector<double> places;
  for (int i = 0; i < count; ++i) places.push_back(spacing * i);
  return places;
}

using Kept = std::vector<std::uint32_t>;

TEST(ContactParticles, StandThreeQuartersOfTwoRadiiApart) {
  EXPECT_EQ(chosenAlong(every(1, 22), 3).particles, (Kept{0, 5, 10, 15, 20}));  // 4.5 mm or more: 5
  EXPECT_EQ(chosenAlong(every(5, 5), 3).particles, (Kept{0, 1, 2, 3, 4}));
  EXPECT_EQ(chosenAlong({0, 2}, 3).particles, (Kept{0}));  // a short strand is its root's sphere
}

TEST(ContactParticles, NeverSkipFurtherThanTwoRadii) {
  // Two edges of 4 mm would be 8, two radii are 6.
  EXPECT_EQ(chosenAlong(every(4, 5), 3).particles, (Kept{0, 1, 2, 3}));  // the tip is within the last sphere
  EXPECT_EQ(chosenAlong({0, 1, 2, 3, 7, 8}, 3).particles,
            (Kept{0, 3, 5}));  // 3 before 7; then 8 at 5 mm, not 7 at 4
}

TEST(ContactParticles, RadiiAreOfEachStrandInGroomOrder) {
  // The shorter strand, which the device has first, is the groom's second.
  Groom groom = metres();
  for (const int count : {22, 19}) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < count; ++i)
      strand.push_back({1e-3f * static_cast<float>(i), static_cast<float>(count), 0});
    groom.addStrand(strand);
  }
  ContactSettings settings = withRadius(0.003);
  settings.radiusFactors = std::make_shared<const std::vector<float>>(std::vector<float>{2.0f});
  const ContactParticles contacts = chooseContactParticles(restOf(groom), settings);
  EXPECT_FLOAT_EQ(contacts.radii[0], 0.003f);
  EXPECT_FLOAT_EQ(contacts.radii[1], 0.006f);
  EXPECT_EQ(contacts.baseRadius, 0.003);
  // 4.5 mm apart, then 9.
  EXPECT_EQ(contacts.particles, (Kept{0, 5, 10, 15, 19, 28, 37}));
}

TEST(ContactParticles, CoarseStrandsHaveLargerRadii) {
  const ContactParticles coarse = chosenAlong(every(10, 4), 3);
  EXPECT_FLOAT_EQ(coarse.radii[0], 0.005f);
  EXPECT_EQ(coarse.particles, (Kept{0, 1, 2, 3}));
  ASSERT_EQ(coarse.warnings.size(), 1u);
  EXPECT_NE(coarse.warnings[0].find("1 of 1 strands is raised from 3 mm, to 5 mm at most (strand 0)"),
            std::string::npos)
      << coarse.warnings[0];
  // One long edge raises the radius of all: the others are pruned with it.
  const ContactParticles one = chosenAlong({0, 2, 4, 6, 8, 10, 12, 14, 26}, 3);
  EXPECT_FLOAT_EQ(one.radii[0], 0.006f);
  EXPECT_EQ(one.particles, (Kept{0, 5, 7, 8}));  // 9 mm or more: 10; then 14, as 26 is 16 away
  EXPECT_TRUE(chosenAlong(every(1, 22), 3).warnings.empty());
}

TEST(ContactParticles, GapsAreToldOfWhereTheyStay) {
  Groom groom = metres();
  groom.addStrand(line({0, 0, 0}, {0, -0.03, 0}, 4));  // edges of 10 mm
  ContactSettings settings;
  settings.radius = 0.003;
  const ContactParticles contacts = chooseContactParticles(restOf(groom), settings);
  EXPECT_FLOAT_EQ(contacts.radii[0], 0.003f);
  EXPECT_EQ(contacts.particles, (Kept{0, 1, 2, 3}));
  ASSERT_EQ(contacts.warnings.size(), 1u);
  EXPECT_NE(contacts.warnings[0].find("1 of 1 strands stand further apart (to 10 mm)"), std::string::npos)
      << contacts.warnings[0];
}

TEST(ContactParticles, TheBaseRadiusIsHalfTheSpacingOfRoots) {
  Groom swatch = metres();
  for (int i = 0; i < 12; ++i)
    swatch.addStrand(line({0.02 * (i % 4), 0, 0.02 * (i / 4)}, {0.02 * (i % 4), -0.1, 0}, 30));
  EXPECT_NEAR(chooseContactParticles(restOf(swatch), {}).baseRadius, 0.01, 1e-9);
  EXPECT_EQ(chooseContactParticles(restOf(swatch), withRadius(0.004)).baseRadius, 0.004);
  // Nothing to measure: half the mean edge.
  Groom single = metres();
  single.addStrand(line({}, {0, -0.1, 0}, 11));
  EXPECT_NEAR(chooseContactParticles(restOf(single), {}).baseRadius, 0.005, 1e-9);
  single.addStrand(line({}, {0, 0, 0.1}, 11));  // from the same root
  EXPECT_NEAR(chooseContactParticles(restOf(single), {}).baseRadius, 0.005, 1e-9);
}

TEST(ContactParticles, CarryTheStrandsMass) {
  Groom groom = metres();
  groom.addStrand(line({}, {0, -0.3, 0}, 40));
  groom.addStrand(line({0.01, 0, 0}, {0.01, -0.1, 0}, 64));
  Material material;
  const auto rest = buildRestState(groom, material, {});
  ASSERT_TRUE(rest);
  const ContactParticles contacts = chooseContactParticles(*rest, withRadius(0.006));
  for (std::size_t s = 0; s < 2; ++s) {
    const double count = contacts.firstOfStrand[s + 1] - contacts.firstOfStrand[s];
    const double metresLong = rest->strandInGroom[s] == 0 ? 0.3 : 0.1;
    EXPECT_NEAR(contacts.masses[s] * count / (material.lineDensity * metresLong), 1, 1e-6);
  }
}

// The law as it is written, one particle after another.
Kept byTheLaw(std::span<const Vec3f> p, double radius, double spacing) {
  Kept kept{0};
  for (;;) {
    const std::uint32_t i = kept.back();
    std::uint32_t j = i + 1;
    while (j < p.size() && apart(p[i], p[j]) < spacing * 2 * radius) ++j;
    if (j == p.size()) return kept;
    kept.push_back(apart(p[i], p[j]) > 2 * radius && j - 1 > i ? j - 1 : j);
  }
}

TEST(ContactParticles, FollowTheLawAndLeaveNoGap) {
  for (const ContactSample& sample : contactSamples()) {
    const RestState rest = restOf(sample.groom);
    for (const ContactSettings& settings : {withRadius({}), withRadius(0.002), withRadius(0.03)}) {
      const ContactParticles contacts = chooseContactParticles(rest, settings);
      ASSERT_EQ(contacts.firstOfStrand.size(), rest.strands.size() + 1);
      ASSERT_EQ(contacts.firstOfStrand.back(), contacts.particles.size());
      for (std::uint32_t s = 0; s < rest.strands.size(); ++s) {
        const auto& strand = rest.strands[s];
        const auto points = std::span(rest.points).subspan(strand.firstParticle, strand.particleCount);
        const double radius = contacts.radii[s];
        EXPECT_GE(radius, contacts.baseRadius);
        Kept kept;
        for (std::uint32_t k = contacts.firstOfStrand[s]; k < contacts.firstOfStrand[s + 1]; ++k) {
          EXPECT_EQ(contacts.strands[k], s);
          kept.push_back(contacts.particles[k] - strand.firstParticle);
        }
        EXPECT_EQ(kept, byTheLaw(points, radius, settings.spacing)) << sample.name << " strand " << s;
        for (std::size_t k = 0; k + 1 < kept.size(); ++k)
          EXPECT_LE(apart(points[kept[k]], points[kept[k + 1]]), 2 * radius)
              << sample.name << " strand " << s;
        // What is dropped lies within s R of the one kept before it.
        for (std::uint32_t i = 0; i < points.size(); ++i) {
          const std::uint32_t before = *(std::upper_bound(kept.begin(), kept.end(), i) - 1);
          EXPECT_LE(apart(points[before], points[i]), settings.spacing * 2 * radius);
        }
      }
    }
  }
}

// Strands of 0 to 40 contact particles, every second one dense.
TEST(ContactParticles, DenseStrandsAreThinned) {
  Groom groom = metres();
  addWandering(groom, 120, 41, {}, {0.15, 0, 0.15}, 0.005, 3);
  const RestState rest = restOf(groom);
  ContactSettings settings = withRadius(0.002);
  const ContactParticles all = chooseContactParticles(rest, settings);
  DenseStrands dense = noDenseStrands(rest);
  for (std::uint32_t s = 0; s < all.strandCount(); s += 2) dense.isIn[s] = true;
  for (const auto& [detail, asked] : {std::pair{1.0, 1u}, {0.5, 2u}, {0.3, 3u}, {0.05, 20u}}) {
    settings.detail = detail;
    const ContactParticles thinned = thinWhereDense(all, rest, dense, settings);
    ASSERT_EQ(thinned.strands.size(), thinned.particles.size());
    ASSERT_EQ(thinned.firstOfStrand.back(), thinned.particles.size());
    std::set<std::uint32_t> phases;
    for (std::uint32_t s = 0; s < all.strandCount(); ++s) {
      const std::span before = std::span(all.particles)
                                   .subspan(all.firstOfStrand[s])
                                   .first(all.firstOfStrand[s + 1] - all.firstOfStrand[s]);
      const std::span after = std::span(thinned.particles)
                                  .subspan(thinned.firstOfStrand[s])
                                  .first(thinned.firstOfStrand[s + 1] - thinned.firstOfStrand[s]);
      const auto count = static_cast<std::uint32_t>(before.size());
      const std::uint32_t q = dense.isIn[s] ? std::max(1u, std::min(asked, count / 2)) : 1;
      ASSERT_FALSE(after.empty());
      const auto phase = static_cast<std::uint32_t>(std::ranges::find(before, after[0]) - before.begin());
      EXPECT_LT(phase, q);
      EXPECT_EQ(after.size(), (count - phase + q - 1) / q);
      for (std::size_t k = 0; k < after.size(); ++k) {
        EXPECT_EQ(after[k], before[phase + k * q]);
        EXPECT_EQ(thinned.strands[thinned.firstOfStrand[s] + k], s);
      }
      EXPECT_FLOAT_EQ(thinned.radii[s], all.radii[s] * std::pow(static_cast<float>(q), 0.2f));
      EXPECT_FLOAT_EQ(thinned.masses[s], all.masses[s] * static_cast<float>(q * q));
      if (q == asked) phases.insert(phase);
    }
    if (asked <= 3) {
      EXPECT_EQ(phases.size(), asked) << "strands begin at different ones";
    }
  }
}

}  // namespace
}  // namespace ringlet::contact_particles_test
