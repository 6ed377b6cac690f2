// rest/root_spacing.h against all pairs.
#include "ringlet/rest/root_spacing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace ringlet::root_spacing_test {
namespace {

double byAllPairs(const std::vector<Vec3d>& points) {
  std::vector<double> all;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < points.size(); ++j)
      if (i != j) nearest = std::min(nearest, length(points[i] - points[j]));
    all.push_back(nearest);
  }
  std::ranges::sort(all);
  return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(points.size());
}

std::vector<Vec3d> scattered(int count, Vec3d spread, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> side;
  std::vector<Vec3d> points;
  for (int i = 0; i < count; ++i)
    points.push_back({spread.x * side(random), spread.y * side(random), spread.z * side(random)});
  return points;
}

TEST(RootSpacing, IsThatOfAllPairs) {
  for (int count : {2, 3, 10, 1000}) {
    for (Vec3d spread : {Vec3d{1, 1, 1}, Vec3d{1, 0, 1}, Vec3d{0, 0, 1}, Vec3d{1e-9, 1e6, 1}}) {
      const auto points = scattered(count, spread, 11);
      EXPECT_EQ(meanNearestDistance(points), byAllPairs(points))
          << count << " " << spread.x << " " << spread.y;
    }
  }
  // Clusters, and points in one place.
  auto points = scattered(300, {1e-3, 1e-3, 1e-3}, 12);
  for (Vec3d p : scattered(300, {1e-3, 0, 1e-3}, 13)) points.push_back(p + Vec3d{5, 5, 5});
  points.insert(points.end(), 100, Vec3d{1, 2, 3});
  EXPECT_EQ(meanNearestDistance(points), byAllPairs(points));
}

TEST(RootSpacing, OfALatticeIsItsSpacing) {
  std::vector<Vec3d> lattice;
  for (int i = 0; i < 400; ++i) lattice.push_back({0.025 * (i % 20), 0, 0.025 * (i / 20)});
  EXPECT_NEAR(meanNearestDistance(lattice), 0.025, 1e-15);
}

TEST(RootSpacing, OfNothingIsZero) {
  EXPECT_EQ(meanNearestDistance({}), 0);
  EXPECT_EQ(meanNearestDistance(std::vector<Vec3d>{{1, 2, 3}}), 0);
  EXPECT_EQ(meanNearestDistance(std::vector<Vec3d>(20000, Vec3d{1, 2, 3})), 0);  // and at once
}

}  // namespace
}  // namespace ringlet::root_spacing_test
