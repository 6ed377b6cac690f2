// Levels of detail: which strands are simulated, and how the others follow them.
#include "ringlet/follow/level_of_detail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "reference/follow_guide.h"
#include "ringlet/follow/guide_rest.h"
#include "ringlet/groom/generate.h"
#include "tests/support/hairs_at_rest.h"

namespace ringlet::test::level_of_detail_test {
namespace {

constexpr double kShares[] = {1, 0.5, 0.25, 0.05, 1e-6};

TEST(LevelOfDetail, EveryStrandLeadsOrFollowsAndKeepsItsShape) {
  std::vector<Groom> grooms;
  for (const int locks : {0, 20})
    grooms.push_back(*makeHead({.curl = {.particleCount = 16}, .strandCount = 150, .lockCount = locks}));
  Groom alone;
  alone.addStrand(grooms[0].strand(0));
  grooms.push_back(alone);
  Groom twice = grooms[0];  // two in each place
  for (std::size_t s = 0; s < grooms[0].strandCount(); ++s) twice.addStrand(grooms[0].strand(s));
  grooms.push_back(twice);
  Groom still = grooms[0];  // whose points are partly in one place: at the root, on the way, at the tip
  for (std::size_t s = 0; s < still.strandCount(); s += 2) {
    const auto points = std::span(still.points).subspan(still.firstPoint[s], still.strand(s).size());
    points[1] = points[0];
    points[7] = points[6];
    points[15] = points[14] = points[13];
  }
  grooms.push_back(still);
  for (const Groom& groom : grooms) {
    const std::size_t count = groom.strandCount();
    for (const double share : kShares) {
      SCOPED_TRACE(testing::Message() << count << " strands, " << share);
      const auto level = levelOfDetail(groom, share);
      ASSERT_TRUE(level) << level.error().message;
      ASSERT_EQ(level->guides.size(), std::max<std::size_t>(1, std::lround(share * double(count))));
      ASSERT_EQ(level->groom.strandCount(), level->guides.size());
      ASSERT_EQ(level->hairs.size(), count);
      std::vector<bool> leads(count, false);
      for (std::size_t g = 0; g < level->guides.size(); ++g) {
        const std::uint32_t s = level->guides[g];
        ASSERT_LT(s, count);
        if (g > 0) {
          EXPECT_LT(level->guides[g - 1], s);
        }
        EXPECT_TRUE(std::ranges::equal(level->groom.strand(g), groom.strand(s)));
        const FollowHair& hair = level->hairs[s];
        EXPECT_EQ(hair.guide, g);
        EXPECT_EQ(hair.offset, Vec3f{});
        EXPECT_EQ((std::vector{hair.phase, hair.radius, hair.length, hair.spread}),
                  (std::vector<float>{0, 1, 1, 1}));
        leads[s] = true;
      }
      for (std::size_t s = 0; s < count; ++s) {
        const FollowHair& hair = level->hairs[s];
        ASSERT_LT(hair.guide, level->guides.size());
        if (leads[s]) continue;
        EXPECT_GT(hair.length, 0);
        EXPECT_LE(hair.length, 1);
      }
      EXPECT_LT(test::farthestAtRest(*level, groom), 1e-6);
    }
  }
}

// Clark and Evans 1954: the mean distance of the nearest over that of places chosen by chance, 0.5 over the
// root of their density; 1 for chance, 2.15 for a hexagonal grid.
TEST(LevelOfDetail, RootsOfGuidesAreEvenlySpread) {
  constexpr int kColumns = 40, kRows = 30;
  Groom swatch;
  for (int k = 0; k < kColumns * kRows; ++k) {
    const Vec3f root{float(k % kColumns), 0, float(k / kColumns)};
    swatch.addStrand(std::vector<Vec3f>{root, root + Vec3f{0, -5, 0}, root + Vec3f{0, -10, 0}});
  }
  for (const double share : {0.5, 0.25, 0.1, 0.05}) {
    SCOPED_TRACE(share);
    const auto level = levelOfDetail(swatch, share);
    ASSERT_TRUE(level);
    double sum = 0;
    for (const std::uint32_t a : level->guides) {
      double nearest = 1e9;
      for (const std::uint32_t b : level->guides)
        if (a != b)
          nearest = std::min<double>(nearest, length(swatch.strand(a).front() - swatch.strand(b).front()));
      sum += nearest;
    }
    EXPECT_GT(sum / double(level->guides.size()) / (0.5 / std::sqrt(share)), 1.35);
  }
}

// A hair that follows a curl, as the reference has it, is found to be that.
TEST(LevelOfDetail, FindsHowAStrandDiffersFromItsGuide) {
  const Groom curl = *makeCurl({.radius = 0.008, .turns = 6, .length = 0.25, .particleCount = 97});
  const std::vector<Vec3d> guide = test::metresOf(curl, 0);
  const GuideRest rest = restOfGuide(guide);
  const reference::GuidePose pose = reference::poseGuide(rest, guide, {});
  for (const float phase : {-2.0f, 0.0f, 0.7f, 3.0f}) {
    for (const float radius : {0.6f, 1.0f, 1.5f}) {
      for (const float length : {1.0f, 0.8f}) {
        for (const float spread : {0.3f, 1.0f, 1.6f}) {
          SCOPED_TRACE(testing::Message() << phase << " " << radius << " " << length << " " << spread);
          const FollowHair wanted{.offset = Vec3f{0.006f, 0.004f, 0.001f},
                                  .phase = phase,
                                  .radius = radius,
                                  .length = length,
                                  .spread = spread};
          std::vector<Vec3f> strand;
          for (const Vec3d& p : reference::followGuide(wanted, pose))
            strand.push_back(Vec3f(p / curl.metresPerUnit));
          Groom groom;
          groom.addStrand(strand);
          groom.addStrand(curl.strand(0));
          const auto level = levelOfDetailOfGuides(groom, {1});
          ASSERT_TRUE(level);
          const FollowHair& found = level->hairs[0];
          EXPECT_LT(ringlet::length(found.offset - wanted.offset), 1e-6f);
          // Lengths are tried in steps of 0.005: half of one is so much of six turns.
          EXPECT_NEAR(std::remainder(found.phase - phase, 2 * std::numbers::pi), 0,
                      0.0025 * 6 * 2 * std::numbers::pi);
          EXPECT_NEAR(found.radius, radius, 0.04 * radius);
          EXPECT_NEAR(found.length, length, 0.02);
          EXPECT_NEAR(found.spread, spread, 0.05);
        }
      }
    }
  }
}

// Of the guides about a strand the one that it is most like, wherever that is among the nearest: here
// straight ones lead where the strand is a curl, but for one of the four.
TEST(LevelOfDetail, AStrandFollowsTheGuideThatFitsIt) {
  const Groom curl = *makeCurl({.radius = 0.008, .turns = 6, .length = 0.25, .particleCount = 97});
  const auto at = [&](Vec3f root, bool isCurl) {
    std::vector<Vec3f> strand(curl.strand(0).begin(), curl.strand(0).end());
    for (std::size_t i = 0; i < strand.size(); ++i)
      strand[i] = root + (isCurl ? strand[i] - curl.points[0] : Vec3f{0, (strand[i] - curl.points[0]).y, 0});
    return strand;
  };
  const Vec3f roots[] = {{0.02f, 0, 0}, {-0.021f, 0, 0}, {0, 0, 0.022f}, {0, 0, -0.023f}};
  for (std::size_t like = 0; like < 4; ++like) {
    Groom groom;
    groom.metresPerUnit = 1;
    groom.addStrand(at({0.001f, 0, 0.001f}, true));
    for (std::size_t g = 0; g < 4; ++g) groom.addStrand(at(roots[g], g == like));
    const auto level = levelOfDetailOfGuides(groom, {1, 2, 3, 4});
    ASSERT_TRUE(level) << level.error().message;
    EXPECT_EQ(level->hairs[0].guide, like);
    EXPECT_NEAR(level->hairs[0].radius, 1, 0.05);
  }
}

TEST(LevelOfDetail, RefusesWhatItCannotDo) {
  Groom groom = *makeHead({.curl = {.particleCount = 8}, .strandCount = 5});
  for (const double share : {0.0, -1.0, 1.5, std::nan("")}) {
    const auto level = levelOfDetail(groom, share);
    ASSERT_FALSE(level) << share;
    EXPECT_NE(level.error().message.find("above 0 and at most 1"), std::string::npos)
        << level.error().message;
  }
  groom.addStrand(std::vector<Vec3f>(3, Vec3f{1, 2, 3}));
  const auto level = levelOfDetail(groom, 0.5);
  ASSERT_FALSE(level);
  EXPECT_NE(level.error().message.find("strand 6 of the groom has no length"), std::string::npos);
}

}  // namespace
}  // namespace ringlet::test::level_of_detail_test
