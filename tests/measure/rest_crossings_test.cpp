// measure/rest_crossings.h: pairs of strands that overlap or cross at rest, against looking at every pair of
// edges.
#include "ringlet/measure/rest_crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "ringlet/groom/generate.h"
#include "ringlet/groom/root_ends.h"
#include "ringlet/rest/root_spacing.h"

namespace ringlet::rest_crossings_test {
namespace {

// Straight strands side by side, a unit apart.
Groom board(int strands) {
  Groom groom;
  for (int s = 0; s < strands; ++s) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < 30; ++i)
      strand.push_back({1.001f * static_cast<float>(s), -static_cast<float>(i), 0});
    groom.addStrand(strand);
  }
  return groom;
}

TEST(RestCrossings, HairSideBySideHasNone) {
  const auto found = restCrossings(board(20));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->width, 1.001, 1e-5);
  EXPECT_EQ(found->pairs, 0u);
  EXPECT_EQ(found->strands, 0u);
}

TEST(RestCrossings, OneThatGoesAcrossCrossesAllThatItMeets) {
  for (const int last : {1, 5, 19}) {
    Groom groom = board(20);
    std::vector<Vec3f> across{{-1, 0, 0}, {-1, -5, 0}, {-1, -9, 0.02f}};
    across.push_back({1.001f * static_cast<float>(last) + 0.1f, -10, 0.02f});
    groom.addStrand(across);
    const auto found = restCrossings(groom);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->pairs, static_cast<std::uint64_t>(last) + 1);
    EXPECT_EQ(found->strands, static_cast<std::size_t>(last) + 2);
    EXPECT_EQ(found->firstStrand, 0u);
    EXPECT_GE(found->overlappingPairs, found->pairs);
  }
}

double distanceOf(Vec3d p, Vec3d a, Vec3d q, Vec3d c) {  // by trying, [0, 1] each in turn
  double s = 0.5, t = 0.5;
  for (int turn = 0; turn < 200; ++turn) {
    s = std::clamp(dot(q + c * t - p, a) / dot(a, a), 0.0, 1.0);
    t = std::clamp(dot(p + a * s - q, c) / dot(c, c), 0.0, 1.0);
  }
  return length(p + a * s - q - c * t);
}

TEST(RestCrossings, AreThoseOfEveryPairOfEdges) {
  for (const double turns : {0.0, 6.0}) {
    const auto groom =
        makeSwatch({.curl = {.radius = 0.02, .turns = turns, .length = 0.1, .particleCount = 30},
                    .columnCount = 4,
                    .rowCount = 3,
                    .spacing = 0.02});
    ASSERT_TRUE(groom);
    const auto found = restCrossings(*groom);
    ASSERT_TRUE(found);
    std::set<std::pair<std::size_t, std::size_t>> overlapping, crossing;
    for (std::size_t a = 0; a < 12; ++a) {
      for (std::size_t b = a + 1; b < 12; ++b) {
        double nearest = HUGE_VAL, alongA = 0;
        const auto one = groom->strand(a), other = groom->strand(b);
        for (std::size_t i = 0; i + 1 < one.size(); ++i) {
          const Vec3d p(one[i]), way = Vec3d(one[i + 1]) - p;
          double alongB = 0;
          for (std::size_t j = 0; j + 1 < other.size(); ++j) {
            const Vec3d q(other[j]), wayB = Vec3d(other[j + 1]) - q;
            if (std::min(alongA, alongB) >= 2 * found->width)
              nearest = std::min(nearest, distanceOf(p, way, q, wayB));
            alongB += length(wayB);
          }
          alongA += length(way);
        }
        if (nearest < found->width) overlapping.insert({a, b});
        if (nearest < kCrossingShare * found->width) crossing.insert({a, b});
      }
    }
    EXPECT_EQ(found->overlappingPairs, overlapping.size()) << turns;
    EXPECT_EQ(found->pairs, crossing.size()) << turns;
    if (turns > 0) {
      EXPECT_GT(crossing.size(), 3u);
    }
  }
}

// Everything in one place is not counted, and is no work; nor are roots without a distance.
TEST(RestCrossings, WhatCannotBeCountedIsNot) {
  Groom knot;
  for (int s = 0; s < 4000; ++s) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < 10; ++i) strand.push_back({static_cast<float>(s % 7), static_cast<float>(i % 3), 0});
    strand.front() = {static_cast<float>(s), 5, 0};
    knot.addStrand(strand);
  }
  EXPECT_FALSE(restCrossings(knot));
  Groom tuft;
  for (int s = 0; s < 9; ++s) tuft.addStrand(std::vector<Vec3f>{{0, 0, 0}, {static_cast<float>(s), -1, 0}});
  EXPECT_FALSE(restCrossings(tuft));
  EXPECT_FALSE(restCrossings(Groom{}));
}

}  // namespace
}  // namespace ringlet::rest_crossings_test
