// groom/stray_points.h and what mends them: particles where no hair is, wherever on a strand, are found and
// taken out; places that strands rightly share are not.
#include "ringlet/groom/stray_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "ringlet/groom/generate.h"
#include "ringlet/groom/mend_groom.h"
#include "ringlet/measure/groom_inspection.h"
#include "tests/groom/groom_samples.h"

namespace ringlet::stray_points_test {
namespace {

// Twenty strands of ten particles a unit apart, hanging beside each other, far from the origin.
Groom goodGroom() {
  Groom groom;
  for (int s = 0; s < 20; ++s) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < 10; ++i)
      strand.push_back({30.f + static_cast<float>(s), 40.f - static_cast<float>(i), 5.f});
    groom.addStrand(strand);
  }
  return groom;
}

// With `place` `count` times before particle `at` of every `step`th strand from `first` on.
Groom with(Vec3f place, std::size_t at, std::size_t count, std::size_t first = 0, std::size_t step = 1) {
  const Groom good = goodGroom();
  Groom groom;
  for (std::size_t s = 0; s < good.strandCount(); ++s) {
    std::vector<Vec3f> strand(good.strand(s).begin(), good.strand(s).end());
    if (s >= first && (s - first) % step == 0)
      strand.insert(strand.begin() + static_cast<std::ptrdiff_t>(at), count, place);
    groom.addStrand(strand);
  }
  return groom;
}

TEST(StrayPoints, AreFoundAtTheEndTheStartAndInTheMiddleAndTakenOut) {
  for (const Vec3f place : {Vec3f{0, 0, 0}, Vec3f{-50, 3, 7}}) {
    for (const std::size_t at : {0u, 4u, 10u}) {
      for (const std::size_t count : {1u, 2u}) {
        for (const std::size_t step : {1u, 3u}) {
          const Groom bad = with(place, at, count, 2, step);
          const std::size_t strands = (20 - 2 + step - 1) / step;
          const GroomInspection found = inspectGroom(bad);
          EXPECT_EQ(found.strayParticles.count, strands * count) << at << " " << count << " " << step;
          EXPECT_EQ(found.strayParticles.firstStrand, 2u);
          EXPECT_EQ(found.longEdges.count, strands * (at == 4 ? 2 : 1));
          EXPECT_EQ(found.sharedParticles.count, 0u);
          const MendedGroom mended = mendGroom(bad);
          EXPECT_TRUE(test::hasSameBits(mended.groom, goodGroom())) << at << " " << count << " " << step;
          EXPECT_EQ(mended.strayCount, strands * count);
          EXPECT_EQ(mended.repeatedCount + mended.duplicateCount + mended.pointStrandCount, 0u);
        }
      }
    }
  }
}

TEST(StrayPoints, AtTheOriginOneStrandIsEnoughElsewhereItsEdgesAreCounted) {
  const GroomInspection origin = inspectGroom(with({0, 0, 0}, 10, 1, 7, 100));
  EXPECT_EQ(origin.strayParticles.count, 1u);
  EXPECT_EQ(origin.strayParticles.firstStrand, 7u);
  const GroomInspection alone = inspectGroom(with({-50, 3, 7}, 10, 1, 7, 100));
  EXPECT_EQ(alone.strayParticles.count, 0u);
  EXPECT_EQ(alone.longEdges.count, 1u);
  EXPECT_EQ(alone.longEdges.firstStrand, 7u);
  EXPECT_TRUE(
      test::hasSameBits(mendGroom(with({-50, 3, 7}, 10, 1, 7, 100)).groom, with({-50, 3, 7}, 10, 1, 7, 100)));
}

// Numbers that stand for no place, in all strands or in one: what is left is what was good.
TEST(StrayPoints, NumbersThatStandForNoPlaceAreTakenOutAndNothingElse) {
  for (const float number : {99999.f, 1e10f, -1e6f, 3.4e38f}) {
    for (const Vec3f place : {Vec3f{number, number, number}, Vec3f{0, number, 0}}) {
      for (const std::size_t at : {0u, 4u, 10u}) {
        for (const std::size_t step : {1u, 3u, 100u}) {
          const Groom bad = with(place, at, 1, 0, step);
          const std::size_t strands = (20 + step - 1) / step;
          const GroomInspection found = inspectGroom(bad);
          EXPECT_EQ(found.strayParticles.count, strands) << number << " " << at << " " << step;
          EXPECT_EQ(found.repeatedParticles.count, 0u) << number << " " << at << " " << step;
          EXPECT_EQ(found.likelyUp, 'Y') << number << " " << at << " " << step;
          EXPECT_EQ(found.longEdges.count, strands * (at == 4 ? 2 : 1)) << number << " " << at << " " << step;
          const MendedGroom mended = mendGroom(bad);
          EXPECT_TRUE(test::hasSameBits(mended.groom, goodGroom())) << number << " " << at << " " << step;
          EXPECT_EQ(mended.strayCount, strands);
        }
      }
    }
  }
}

// Every particle twice, a hair's breadth apart, as files have them: no edge is far, and both tips stay.
// Of the two edges of such a strand the shorter says how long edges are.
TEST(StrayPoints, OfThreeParticlesOneMayBeStray) {
  Groom groom;
  for (int s = 0; s < 20; ++s) {
    const float x = 30.f + static_cast<float>(s);
    groom.addStrand(std::vector<Vec3f>{{x, 40, 5}, {x, 39, 5}, {-50, 3, 7}});
  }
  EXPECT_EQ(inspectGroom(groom).strayParticles.count, 20u);
  EXPECT_EQ(mendGroom(groom).groom.points.size(), 40u);
}

TEST(StrayPoints, PairsOfParticlesAreNone) {
  const Groom good = goodGroom();
  Groom pairs;
  for (std::size_t s = 0; s < 20; ++s) {
    std::vector<Vec3f> strand;
    for (const Vec3f p : good.strand(s)) {
      strand.push_back(p);
      if (s % 2 == 0 || strand.size() > 1) strand.push_back({p.x + 2e-4f, p.y, p.z});
    }
    pairs.addStrand(strand);
  }
  pairs.addStrand(std::vector<Vec3f>{{30, 50, 5}, {30.0002f, 50, 5}, {31, 50, 5}});
  EXPECT_EQ(inspectGroom(pairs).strayParticles.count, 0u);
  EXPECT_EQ(mendGroom(pairs).strayCount, 0u);
}

TEST(StrayPoints, WhatStrandsRightlyShareStays) {
  // A tuft from one root, which is at the origin too; strands that end in one place; a strand twice.
  Groom tuft, knot = goodGroom();
  for (int s = 0; s < 9; ++s)
    tuft.addStrand(std::vector<Vec3f>{
        {0, 0, 0}, {0.1f * static_cast<float>(s), -1, 0}, {0.2f * static_cast<float>(s), -2, 0}});
  const GroomInspection found = inspectGroom(tuft);
  EXPECT_EQ(found.strayParticles.count, 0u);
  EXPECT_EQ(found.sharedParticles.count, 9u);
  EXPECT_TRUE(test::hasSameBits(mendGroom(tuft).groom, tuft));
  knot.addStrand(goodGroom().strand(3));
  const GroomInspection twice = inspectGroom(knot);
  EXPECT_EQ(twice.sharedParticles.count + twice.strayParticles.count, 0u);
  EXPECT_EQ(twice.duplicates.count, 1u);
}

TEST(StrayPoints, TwoParticlesStayOfAStrand) {
  Groom groom = goodGroom();
  groom.addStrand(std::vector<Vec3f>{{0, 0, 0}, {30, 40, 5}});
  groom.addStrand(std::vector<Vec3f>{{0, 0, 0}, {0, 0, 0}, {30, 40, 9}});
  const MendedGroom mended = mendGroom(groom);
  EXPECT_EQ(mended.groom.strandCount(), 22u);
  EXPECT_EQ(mended.strayCount, 0u);
}

TEST(StrayPoints, GeneratedGroomsHaveNone) {
  const auto curl = makeCurl({});
  const auto swatch = makeSwatch({});
  const auto head = makeHead({});
  ASSERT_TRUE(curl && swatch && head);
  for (const Groom& groom : {*curl, *swatch, *head}) {
    const GroomInspection found = inspectGroom(groom);
    EXPECT_EQ(found.strayParticles.count + found.sharedParticles.count + found.longEdges.count, 0u);
  }
}

// Mending what is mended changes no bit, whatever was wrong.
TEST(MendGroom, IsDoneAtOnce) {
  std::vector<Groom> bad;
  for (const std::size_t at : {0u, 5u, 10u}) {
    bad.push_back(with({0, 0, 0}, at, 1));
    bad.push_back(with({-50, 3, 7}, at, 2, 1, 4));
  }
  // Taking out strays makes strands repeat others, or leaves repeats side by side.
  Groom chained = with({0, 0, 0}, 10, 1);
  chained.addStrand(goodGroom().strand(0));
  const Groom good = goodGroom();
  std::vector<Vec3f> around(good.strand(1).begin(), good.strand(1).end());
  around.insert(around.begin() + 5, {Vec3f{0, 0, 0}, around[4]});
  chained.addStrand(around);
  chained.addStrand(std::vector<Vec3f>{{0, 0, 0}, {1, 1, 1}, {1, 1, 1}, {0, 0, 0}});
  bad.push_back(chained);
  for (const Groom& groom : bad) {
    const MendedGroom once = mendGroom(groom), again = mendGroom(once.groom);
    EXPECT_FALSE(test::hasSameBits(once.groom, groom));
    EXPECT_TRUE(test::hasSameBits(again.groom, once.groom));
    EXPECT_EQ(again.strayCount + again.repeatedCount + again.duplicateCount + again.pointStrandCount, 0u);
    EXPECT_EQ(inspectGroom(once.groom).strayParticles.count, 0u);
  }
}

}  // namespace
}  // namespace ringlet::stray_points_test
