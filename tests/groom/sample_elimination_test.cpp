// groom/sample_elimination.h: what stays is evenly spread.
#include "ringlet/groom/sample_elimination.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

namespace ringlet::sample_elimination_test {
namespace {

// Points of a square of 1 m, thrown at random.
std::vector<Vec3d> thrown(std::size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back({share(random), 0, share(random)});
  return points;
}

double leastDistance(const std::vector<Vec3d>& points, const std::vector<std::uint32_t>& kept) {
  double least = 1;
  for (std::size_t a = 0; a < kept.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) least = std::min(least, length(points[kept[a]] - points[kept[b]]));
  return least;
}

TEST(SampleElimination, WhatStaysIsEvenlySpread) {
  const std::vector<Vec3d> points = thrown(2500);
  const auto kept = eliminateSamples(points, 500, 1);
  ASSERT_EQ(kept.size(), 500u);
  EXPECT_TRUE(std::ranges::is_sorted(kept));
  EXPECT_EQ(std::set(kept.begin(), kept.end()).size(), 500u);
  // The paper: discs of 0.7 of the largest radius and more; the first 500, at random, are 100 times nearer.
  const double largest = 2 * std::sqrt(1 / (2 * std::numbers::sqrt3 * 500));
  EXPECT_GT(leastDistance(points, kept), 0.6 * largest);
  std::vector<std::uint32_t> first(500);
  for (std::uint32_t i = 0; i < 500; ++i) first[i] = i;
  EXPECT_LT(leastDistance(points, first), 0.1 * largest);
  EXPECT_EQ(eliminateSamples(points, 500, 1), kept);
}

TEST(SampleElimination, FewerPointsAllStay) {
  EXPECT_EQ(eliminateSamples(thrown(3), 3, 1), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(eliminateSamples(thrown(2), 3, 1), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_TRUE(eliminateSamples({}, 3, 1).empty());
  EXPECT_TRUE(eliminateSamples(thrown(2), 0, 1).empty());
}

}  // namespace
}  // namespace ringlet::sample_elimination_test
