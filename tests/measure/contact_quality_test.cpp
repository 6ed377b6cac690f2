// measure/contact_quality.h: closed forms, and all pairs of particles.
#include "ringlet/measure/contact_quality.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <optional>
#include <random>

#include "tests/rest/contact_samples.h"

namespace ringlet::contact_quality_test {
namespace {

using namespace test;

// Pairs that are apart at rest are pruned.
ContactSettings radius(std::optional<double> r) {
  ContactSettings settings;
  settings.prunePairs = true;
  settings.radius = r;
  return settings;
}

struct Prepared {
  RestState rest;
  RestContacts contacts;

  explicit Prepared(const Groom& groom, const ContactSettings& settings = radius({}))
      : rest(restOf(groom)), contacts(buildRestContacts(rest, settings)) {}
  ContactQuality at(std::span<const Vec3f> positions) const {
    return measureContacts(rest, contacts, positions);
  }
};

// Two parallel lines of 20 contact particles of radius 2.5 mm, 4 mm apart along and `apart` across.
Groom twoLines(double apart) {
  Groom groom = metres();
  groom.addStrand(line({}, {0, -0.076, 0}, 20));
  groom.addStrand(line({apart, 0, 0}, {apart, -0.076, 0}, 20));
  return groom;
}
TEST(ContactQuality, OfTwoLinesPressedTogether) {
  // Apart at rest, then the spheres that face each other 3 mm from each other, 20 pairs; next ones 5 mm:
  // beyond R.
  const Prepared p(twoLines(0.02), radius(0.0025));
  EXPECT_EQ(p.at(twoLines(0.02).points).overlapping, 0u);
  EXPECT_EQ(p.at(twoLines(0.02).points).rawRecall, 1);
  const ContactQuality pressed = p.at(twoLines(0.0035).points);
  EXPECT_EQ(pressed.overlapping, 20u);
  EXPECT_NEAR(pressed.deepestOverlap, 0.3, 1e-6);
  EXPECT_NEAR(pressed.overlapBeyondRestSum, 20 * 0.3, 1e-5);
  EXPECT_EQ(pressed.rawRecall, 0) << "apart at rest, their pair is pruned";
  ContactSettings all = radius(0.0025);
  all.prunePairs = false;
  EXPECT_EQ(Prepared(twoLines(0.02), all).at(twoLines(0.0035).points).rawRecall, 1);
}

// A longer strand comes before in the device's order; the numbers are in the groom's.
TEST(ContactQuality, OverlapsAreThoseOfEachStrand) {
  Groom groom = metres(), later = metres();
  for (Groom* each : {&groom, &later}) each->addStrand(line({1, 0, 0}, {1, -0.116, 0}, 30));
  const Groom apart = twoLines(0.02), pressed = twoLines(0.0035);
  for (std::size_t s = 0; s < 2; ++s) groom.addStrand(apart.strand(s)), later.addStrand(pressed.strand(s));
  const Prepared p(groom, radius(0.0025));
  EXPECT_EQ(overlapOfStrands(p.rest, p.contacts, groom.points), (std::vector<float>{0, 0, 0}));
  const std::vector<float> overlaps = overlapOfStrands(p.rest, p.contacts, later.points);
  ASSERT_EQ(overlaps.size(), 3u);
  EXPECT_EQ(overlaps[0], 0);
  EXPECT_NEAR(overlaps[1], 0.3, 1e-6);
  EXPECT_NEAR(overlaps[2], 0.3, 1e-6);
}

TEST(ContactQuality, WhatOverlapsAtRestMay) {
  // At rest 4 mm apart, R is 5 mm: nothing is beyond rest until they are nearer than 4.
  const Prepared p(twoLines(0.004), radius(0.0025));
  const ContactQuality atRest = p.at(twoLines(0.004).points);
  EXPECT_EQ(atRest.overlapping, 20u);
  EXPECT_EQ(atRest.overlapBeyondRestSum, 0);
  EXPECT_EQ(atRest.deepestOverlap, 0);
  EXPECT_EQ(atRest.rawRecall, 1);
  const ContactQuality pressed = p.at(twoLines(0.0035).points);
  EXPECT_NEAR(pressed.deepestOverlap, 0.1, 1e-6);
}

TEST(ContactQuality, BundlesAreLeftOut) {
  Groom groom = twoLines(0.0035);
  groom.addStrand(line({0.007, 0, 0}, {0.007, -0.076, 0}, 20));
  ContactSettings settings = radius(0.0025);
  const ContactQuality all = Prepared(groom, settings).at(groom.points);
  settings.bundles = std::make_shared<const std::vector<ContactBundle>>(std::vector<ContactBundle>{{0, 1}});
  const ContactQuality some = Prepared(groom, settings).at(groom.points);
  EXPECT_EQ(all.overlapping, 40u);
  EXPECT_EQ(some.overlapping, 20u);
}

TEST(ContactQuality, RecallCountsPairsOfSpheres) {
  // Two pairs of lines: one pair beside each other at rest and still, the other brought together.
  Groom groom = twoLines(0.004), later = groom;
  for (double x : {1.0, 1.02}) groom.addStrand(line({x, 0, 0}, {x, -0.076, 0}, 20));
  for (double x : {1.0, 1.0035}) later.addStrand(line({x, 0, 0}, {x, -0.076, 0}, 20));
  const ContactQuality quality = Prepared(groom, radius(0.0025)).at(later.points);
  EXPECT_EQ(quality.overlapping, 40u);
  EXPECT_EQ(quality.rawRecall, 0.5);
}

// Every pair of contact particles, strand by strand of the groom.
ContactQuality byAllPairs(const Prepared& p, std::span<const Vec3f> positions) {
  ContactQuality quality;
  double allowed = 0;
  const auto now = [&](std::size_t i) {
    const std::uint32_t s = p.contacts.particles.strands[i];
    return static_cast<Vec3d>(positions[p.rest.firstInGroom[s] + (p.contacts.particles.particles[i] -
                                                                  p.rest.strands[s].firstParticle)]);
  };
  const auto before = [&](std::size_t i) {
    return static_cast<Vec3d>(p.rest.points[p.contacts.particles.particles[i]]);
  };
  for (std::size_t i = 0; i < p.contacts.particles.particles.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const std::uint32_t a = p.contacts.particles.strands[i], b = p.contacts.particles.strands[j];
      const double R = double{p.contacts.particles.radii[a]} + double{p.contacts.particles.radii[b]};
      const double d = length(now(i) - now(j)), rest = length(before(i) - before(j));
      if (a == b || d >= R) continue;
      ++quality.overlapping;
      allowed += p.contacts.graph.allows(a, b) ? 1 : 0;
      const double overlap = rest < R ? (rest - d) / R : (R - d) / R;
      if (overlap <= 0) continue;
      quality.overlapBeyondRestSum += overlap;
      quality.deepestOverlap = std::max(quality.deepestOverlap, overlap);
    }
  }
  if (quality.overlapping > 0) quality.rawRecall = allowed / static_cast<double>(quality.overlapping);
  return quality;
}

TEST(ContactQuality, IsThatOfAllPairs) {
  for (const ContactSample& sample : contactSamples()) {
    const Prepared p(sample.groom);
    std::mt19937 random(51);
    std::normal_distribution<double> noise(0, 1.5 * p.contacts.particles.baseRadius);
    std::vector<Vec3f> moved = sample.groom.points;
    for (Vec3f& x : moved) x += static_cast<Vec3f>(Vec3d{noise(random), noise(random), noise(random)});
    for (const auto& positions : {sample.groom.points, moved}) {
      const ContactQuality found = p.at(positions), expected = byAllPairs(p, positions);
      EXPECT_EQ(found.overlapping, expected.overlapping) << sample.name;
      EXPECT_EQ(found.rawRecall, expected.rawRecall) << sample.name;
      EXPECT_EQ(found.deepestOverlap, expected.deepestOverlap) << sample.name;
      EXPECT_NEAR(found.overlapBeyondRestSum, expected.overlapBeyondRestSum,
                  1e-12 * expected.overlapBeyondRestSum)
          << sample.name;
    }
    EXPECT_EQ(p.at(sample.groom.points).overlapBeyondRestSum, 0) << sample.name << " at rest";
  }
}

// What hair does is measured with all of them, and who may touch whom depends on none.
TEST(ContactQuality, IsThatOfParticlesBeforeTheyAreThinned) {
  Groom bunch = metres();
  for (int s = 0; s < 30; ++s) bunch.addStrand(line({0.0002 * s, 0, 0}, {0.0002 * s, -0.076, 0}, 20));
  Groom pressed = metres();
  for (int s = 0; s < 30; ++s) pressed.addStrand(line({0.0001 * s, 0, 0}, {0.0001 * s, -0.076, 0}, 20));
  ContactSettings settings = radius(0.0025);
  const Prepared all(bunch, settings);
  settings.detail = 0.25;
  const Prepared thinned(bunch, settings);
  ASSERT_LT(3 * thinned.contacts.particles.particles.size(), all.contacts.particles.particles.size());
  const ContactQuality a = all.at(pressed.points), b = thinned.at(pressed.points);
  EXPECT_GT(a.overlapping, 1000u);
  EXPECT_EQ(b.overlapping, a.overlapping);
  EXPECT_EQ(b.overlapBeyondRestSum, a.overlapBeyondRestSum);
  EXPECT_EQ(b.rawRecall, a.rawRecall);
  EXPECT_EQ(thinned.contacts.graph.pairs, all.contacts.graph.pairs);
}

TEST(ContactQuality, WhatIsNotFiniteOverlapsNothing) {
  const Prepared p(twoLines(0.02), radius(0.0025));
  std::vector<Vec3f> positions = twoLines(0.0035).points;
  positions[3].y = std::numeric_limits<float>::quiet_NaN();
  positions[24].x = std::numeric_limits<float>::infinity();
  const ContactQuality quality = p.at(positions);
  EXPECT_EQ(quality.overlapping, 18u);
  EXPECT_NEAR(quality.overlapBeyondRestSum, 18 * 0.3, 1e-5);
}

}  // namespace
}  // namespace ringlet::contact_quality_test
