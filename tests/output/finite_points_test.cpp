// Particles without a position end their strand where it last had one.
#include "ringlet/output/finite_points.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace ringlet::finite_points_test {
namespace {

TEST(FinitePoints, StrandEndsWhereItWasLastFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  Groom groom;
  groom.addStrand(std::vector<Vec3f>(4));
  groom.addStrand(std::vector<Vec3f>(2));
  std::vector<Vec3f> points{{1, 1, 1}, {2, nan, 2}, {-infinity, 0, 0}, {3, 3, 3}, {nan, nan, nan}, {4, 4, 4}};
  EXPECT_EQ(replaceNonfinite(groom, points), 3u);
  EXPECT_EQ(points, (std::vector<Vec3f>{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {3, 3, 3}, {0, 0, 0}, {4, 4, 4}}));
  EXPECT_EQ(replaceNonfinite(groom, points), 0u);
}

TEST(FinitePoints, AreFiniteUnlessSomeNumberIsNot) {
  const float most = std::numeric_limits<float>::max();
  std::vector<Vec3f> points(7, Vec3f{most, -most, 0});
  EXPECT_TRUE(areFinite(points));
  EXPECT_TRUE(areFinite({}));
  for (const float wrong : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity()}) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (float Vec3f::*part : {&Vec3f::x, &Vec3f::y, &Vec3f::z}) {
        std::vector<Vec3f> changed = points;
        changed[i].*part = wrong;
        EXPECT_FALSE(areFinite(changed)) << wrong << " at " << i;
      }
    }
  }
}

}  // namespace
}  // namespace ringlet::finite_points_test
