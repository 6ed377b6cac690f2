// base/box_pairs.h against all pairs: every overlapping pair once, whatever the boxes.
#include "ringlet/base/box_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace ringlet::box_pairs_test {
namespace {

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

Pairs byGrids(const std::vector<Box>& boxes) {
  const BoxPairs grids(boxes);
  Pairs pairs;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    grids.visitPartners(i, [&](std::size_t j) { pairs.push_back({i, j}); });
  return pairs;
}

Pairs sorted(Pairs pairs) {
  for (auto& [a, b] : pairs)
    if (a > b) std::swap(a, b);
  std::ranges::sort(pairs);
  return pairs;
}

Pairs byAllPairs(const std::vector<Box>& boxes) {
  Pairs pairs;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = i + 1; j < boxes.size(); ++j) {
      const Vec3d gap = boxes[i].centre - boxes[j].centre, reach = boxes[i].halfSize + boxes[j].halfSize;
      if (std::abs(gap.x) <= reach.x && std::abs(gap.y) <= reach.y && std::abs(gap.z) <= reach.z)
        pairs.push_back({i, j});
    }
  }
  return pairs;
}

// Cubes about random places of a box of the given sizes.
std::vector<Box> cubes(int count, Vec3d spread, double smallest, double largest, Vec3d about = {}) {
  std::mt19937 random(count);
  std::uniform_real_distribution<double> side(-0.5, 0.5), exponent(std::log(smallest), std::log(largest));
  std::vector<Box> boxes;
  for (int i = 0; i < count; ++i) {
    const double half = std::exp(exponent(random)) / 2;
    const Vec3d place{spread.x * side(random), spread.y * side(random), spread.z * side(random)};
    boxes.push_back({about + place, {half, half, half}});
  }
  return boxes;
}

void expectExact(const std::vector<Box>& boxes, bool someOverlap = true) {
  const Pairs found = byGrids(boxes);
  EXPECT_EQ(sorted(found), byAllPairs(boxes));
  EXPECT_EQ(found, byGrids(boxes)) << "not the same order twice";
  EXPECT_EQ(found.empty(), !someOverlap);
}

TEST(BoxPairs, AreThoseOfAllPairs) {
  for (int count : {1, 2, 500, 3000}) expectExact(cubes(count, {1, 1, 1}, 0.08, 0.08), count >= 500);
}

TEST(BoxPairs, OfAnySizesTogether) {
  expectExact(cubes(2000, {1, 1, 1}, 1e-6, 0.5));
  // One box over all the others: its size must not be theirs.
  auto boxes = cubes(2000, {1, 1, 1}, 0.02, 0.02);
  boxes.push_back({{0, 0, 0}, {3, 3, 3}});
  expectExact(boxes);
}

TEST(BoxPairs, OfFlatAndLongBoxes) {
  auto boxes = cubes(2000, {1, 1, 1}, 0.02, 0.2);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (i % 3 == 0) boxes[i].halfSize.y = 0;
    if (i % 3 == 1) boxes[i].halfSize.x *= 10;
  }
  expectExact(boxes);
}

TEST(BoxPairs, WhereverTheyAre) {
  expectExact(cubes(800, {1e-9, 1e-9, 1e-9}, 0.1, 0.2));             // all in one cell
  expectExact(cubes(800, {0, 0, 0}, 0.1, 0.2));                      // all in one place
  expectExact(cubes(800, {30, 0, 0}, 0.1, 0.2));                     // a line along an axis
  expectExact(cubes(800, {0, 30, 1e-7}, 0.1, 0.2));                  // a line, nearly
  expectExact(cubes(2000, {1, 1, 1}, 0.05, 0.1, {-3e5, 7e6, 1e4}));  // far from the origin
  auto clustered = cubes(700, {0.1, 0.1, 0.1}, 0.01, 0.02);          // clusters far apart
  for (Vec3d about : {Vec3d{1e4, 0, 0}, Vec3d{0, -3, 1e9}}) {
    for (const Box& box : cubes(700, {0.1, 0.1, 0.1}, 0.01, 0.02, about)) clustered.push_back(box);
  }
  expectExact(clustered);
}

TEST(BoxPairs, TouchingBoxesCountAndPointsMayMeet) {
  // A lattice of cubes of its own spacing, which is no fraction of two: each touches its 26 neighbours.
  std::vector<Box> lattice;
  const double spacing = 0.1;
  for (int i = 0; i < 1000; ++i) {
    const Vec3d place{double(i % 10), double(i / 10 % 10), double(i / 100)};
    lattice.push_back({place * spacing, {spacing / 2, spacing / 2, spacing / 2}});
  }
  EXPECT_EQ(byGrids(lattice).size(), 3u * 900 + 6u * 810 + 4u * 729);  // faces, edges, corners
  const Box point{{1, 2, 3}, {}};
  EXPECT_EQ(byGrids({point, point, {{1, 2, 4}, {}}}).size(), 1u);
  EXPECT_TRUE(byGrids({}).empty());
}

TEST(BoxPairs, WhatIsNotFiniteOverlapsNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  auto boxes = cubes(300, {1, 1, 1}, 0.2, 0.3);
  const Pairs expected = byAllPairs(boxes);
  for (const Box& lost : {Box{{nan, 0, 0}, {1, 1, 1}}, Box{{0, inf, 0}, {1, 1, 1}},
                          Box{{0, 0, 0}, {1, nan, 1}}, Box{{0, 0, 0}, {inf, inf, inf}}}) {
    boxes.push_back(lost);
  }
  EXPECT_EQ(sorted(byGrids(boxes)), expected);
}

// All comparisons of boxes.
std::size_t workOf(const std::vector<Box>& boxes) {
  const BoxPairs pairs(boxes);
  std::size_t work = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) work += pairs.comparedCount(i);
  return work;
}

// As many boxes in as much more room: each is compared with as many as before.
TEST(BoxPairs, WorkGrowsAsTheNumberOfBoxes) {
  const auto dense = [](int count) {
    const double side = std::cbrt(count / 1000.0);
    return cubes(count, {side, side, side}, 0.05, 0.15);
  };
  const auto few = static_cast<double>(workOf(dense(2000))), many = static_cast<double>(workOf(dense(32000)));
  EXPECT_LT(many, 1.3 * 16 * few) << "boxes at the rim have fewer beside them, more so among few boxes";
  EXPECT_GT(many, 16 * few / 1.3);
  EXPECT_GE(few, static_cast<double>(byAllPairs(dense(2000)).size())) << "what overlaps was compared";
}

TEST(BoxPairs, AFewLargeBoxesCostLittle) {
  // 100,000 small boxes of which few overlap, and one as large as all: by one grid 5e9 comparisons.
  auto boxes = cubes(100000, {10, 10, 10}, 0.01, 0.02);
  const std::size_t before = workOf(boxes), overlaps = byGrids(boxes).size();
  EXPECT_LT(before, 100000u);
  boxes.push_back({{0, 0, 0}, {10, 10, 10}});
  // Each small box is compared with the large one; cells are those of another size now.
  EXPECT_GE(workOf(boxes), 100000 + overlaps);
  EXPECT_LE(workOf(boxes), 100000 + 2 * before);
  EXPECT_EQ(byGrids(boxes).size(), overlaps + 100000);
}

}  // namespace
}  // namespace ringlet::box_pairs_test
