// Tests bodies/near_triangles.h against the tree of the same triangles.
#include "ringlet/bodies/near_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "ringlet/bodies/triangle_tree.h"
#include "tests/bodies/body_samples.h"

namespace ringlet::test::near_triangles_test {
namespace {

constexpr double kLeastReach = 0.004;

// Two balls that overlap, and one in neither that is smaller than a cell of many triangles.
TriangleMesh threeBalls() {
  TriangleMesh mesh;
  const auto add = [&](double radius, Vec3d middle) {
    const TriangleMesh ball = sphereMesh(radius, 6);
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const Vec3d& point : ball.points) mesh.points.push_back(point + middle);
    for (const auto& t : ball.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  };
  add(0.1, {0, 0, 0});
  add(0.06, {0.1, 0.02, 0});
  add(0.005, {-0.13, 0.1, 0.05});
  return mesh;
}

std::vector<Vec3d> placesAbout(int count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> side(-0.18, 0.18);
  std::vector<Vec3d> places;
  for (int i = 0; i < count; ++i) places.push_back({side(random), side(random), side(random)});
  return places;
}

TEST(NearTriangles, SaysHowFarWhatIsNearIs) {
  const TriangleMesh mesh = threeBalls();
  const TriangleTree tree(mesh);
  const NearTriangles near(mesh, kLeastReach);
  ASSERT_GE(near.reach(), kLeastReach);
  int nearCount = 0;
  for (const Vec3d place : placesAbout(20000)) {
    const double distance = tree.nearest(place).distance;
    const std::size_t cell = near.cellAt(place);
    if (cell == NearTriangles::kNoCell || near.kindOf(cell) != NearTriangles::Cell::near) {
      EXPECT_GE(distance, near.reach());
      continue;
    }
    ++nearCount;
    EXPECT_EQ(near.distanceTo(place, cell), std::min(distance, near.reach()));
  }
  EXPECT_GT(nearCount, 1000);
}

TEST(NearTriangles, WhatItCallsOutsideIs) {
  const TriangleMesh mesh = threeBalls();
  const TriangleTree tree(mesh);
  const NearTriangles near(mesh, kLeastReach);
  int outside = 0, enclosed = 0;
  for (const Vec3d place : placesAbout(20000)) {
    const std::size_t cell = near.cellAt(place);
    if (cell != NearTriangles::kNoCell && near.kindOf(cell) == NearTriangles::Cell::near) continue;
    const bool isEnclosed =
        cell != NearTriangles::kNoCell && near.kindOf(cell) != NearTriangles::Cell::outside;
    (isEnclosed ? enclosed : outside) += 1;
    EXPECT_EQ(tree.windingNumber(place) > 0.5, isEnclosed);
  }
  EXPECT_GT(outside, 1000);
  EXPECT_GT(enclosed, 100);
}

// Short ways from every place, in all directions.
TEST(NearTriangles, NothingIsBetweenPlacesOfTwoSides) {
  const TriangleMesh mesh = threeBalls();
  const TriangleTree tree(mesh);
  const NearTriangles near(mesh, kLeastReach);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> step(-0.57, 0.57);  // within the reach
  int free = 0, kept = 0;
  for (const Vec3d place : placesAbout(40000)) {
    const std::size_t cell = near.cellAt(place);
    if (cell == NearTriangles::kNoCell || near.kindOf(cell) != NearTriangles::Cell::near) continue;
    const Vec3d other = place + Vec3d{step(random), step(random), step(random)} * near.reach();
    const bool isOneSide = std::round(tree.windingNumber(place)) == std::round(tree.windingNumber(other));
    const bool isFree = near.isFreeBetween(place, other, cell);
    EXPECT_TRUE(isOneSide || !isFree);
    (isFree ? free : kept) += 1;
  }
  EXPECT_GT(free, 1000);
  EXPECT_GT(kept, 100);
}

}  // namespace
}  // namespace ringlet::test::near_triangles_test
