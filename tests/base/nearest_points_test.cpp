// base/nearest_points.h against looking at all points.
#include "ringlet/base/nearest_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace ringlet::nearest_points_test {
namespace {

TEST(NearestPoints, AreThoseOfASearchThroughAll) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const std::size_t size : {0u, 1u, 2u, 3u, 17u, 400u}) {
    for (const bool isFlat : {false, true}) {
      std::vector<Vec3d> points;
      for (std::size_t i = 0; i < size; ++i)
        points.push_back({number(random), isFlat ? 0 : number(random), number(random)});
      const NearestPoints tree(points);
      for (int query = 0; query < 50; ++query) {
        const Vec3d place{number(random), number(random), number(random)};
        std::vector<double> distances;
        for (const Vec3d& point : points) distances.push_back(length(point - place));
        std::ranges::sort(distances);
        for (const std::size_t count : {0u, 1u, 2u, 5u, 16u}) {
          std::vector<NearestPoints::Near> found;
          tree.find(place, count, found);
          ASSERT_EQ(found.size(), std::min(count, size));
          for (std::size_t k = 0; k < found.size(); ++k) {
            EXPECT_EQ(found[k].distance, distances[k]);
            EXPECT_EQ(found[k].distance, length(points[found[k].point] - place));
          }
        }
      }
    }
  }
}

// Many points in one place are no more work than others: this would not end.
TEST(NearestPoints, ManyInOnePlaceAreQuick) {
  const std::vector<Vec3d> points(200'000, Vec3d{1, 2, 3});
  const NearestPoints tree(points);
  std::vector<NearestPoints::Near> found;
  for (const Vec3d& point : points) tree.find(point, 12, found);
  EXPECT_EQ(found.size(), 12u);
  EXPECT_EQ(found.back().distance, 0);
}

}  // namespace
}  // namespace ringlet::nearest_points_test
