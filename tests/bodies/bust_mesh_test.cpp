// bodies/bust_mesh.h: closed, without folds, and of a person's size.
#include "ringlet/bodies/bust_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <utility>

#include "ringlet/bodies/triangle_tree.h"

namespace ringlet::bust_mesh_test {
namespace {

TEST(BustMesh, IsClosedAndSmooth) {
  const TriangleMesh mesh = makeBustMesh();
  ASSERT_TRUE(checkMesh(mesh));
  EXPECT_TRUE(isWatertight(mesh));
  EXPECT_GE(mesh.triangles.size(), 1500u);
  EXPECT_LE(mesh.triangles.size(), 5000u);
  EXPECT_EQ(mesh.points.size(), mesh.triangles.size() / 2 + 2);  // Euler: one piece without handles
  double longest = 0, sharpest = 1, least = 1;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3d> normals;  // of the triangle left of an edge
  for (const auto& t : mesh.triangles) {
    const Vec3d a = mesh.points[t[0]], b = mesh.points[t[1]], c = mesh.points[t[2]];
    const Vec3d across = cross(b - a, c - a), normal = normalizedOr(across, Vec3d{});
    longest = std::max({longest, length(b - a), length(c - b), length(a - c)});
    least = std::min(least, length(across) / 2);
    for (std::size_t i = 0; i < 3; ++i) {
      normals[{t[i], t[(i + 1) % 3]}] = normal;
      const auto other = normals.find({t[(i + 1) % 3], t[i]});
      if (other != normals.end()) sharpest = std::min(sharpest, dot(normal, other->second));
    }
  }
  std::printf("%zu triangles, edges up to %.1f mm, turns up to %.0f degrees, areas from %.1f mm^2\n",
              mesh.triangles.size(), longest * 1000, std::acos(sharpest) * 180 / std::numbers::pi,
              least * 1e6);
  EXPECT_LT(longest, 0.045);
  EXPECT_GT(least, 1e-6);
  EXPECT_GT(sharpest, 0.4) << "66 degrees, at the tip of the nose";
}

TEST(BustMesh, HasAHeadANeckAndShoulders) {
  const TriangleMesh mesh = makeBustMesh();
  const Bounds bounds = boundsOf(mesh);
  EXPECT_NEAR(bounds.high.y, 0.12, 1e-3);
  EXPECT_NEAR(bounds.low.y, -0.358, 2e-3);
  EXPECT_NEAR(bounds.low.x, -bounds.high.x, 1e-12);
  EXPECT_NEAR(bounds.high.x, 0.206, 2e-3);
  const TriangleTree tree(mesh);
  const auto isInside = [&](Vec3d p) { return tree.windingNumber(p) > 0.5; };
  EXPECT_TRUE(isInside({0, 0, 0}));
  EXPECT_TRUE(isInside({0, -0.036, 0.1})) << "the nose";
  EXPECT_FALSE(isInside({0.03, -0.036, 0.1})) << "beside it";
  EXPECT_TRUE(isInside({0, -0.1, 0.07})) << "the chin";
  EXPECT_FALSE(isInside({0, -0.14, 0.07})) << "below it";
  EXPECT_TRUE(isInside({0, -0.14, 0})) << "the neck";
  EXPECT_FALSE(isInside({0.08, -0.14, 0})) << "beside it";
  for (const double side : {-0.16, 0.16}) {
    EXPECT_TRUE(isInside({side, -0.23, -0.02})) << "a shoulder";
    EXPECT_FALSE(isInside({side, -0.18, -0.02})) << "above it";
  }
}

}  // namespace
}  // namespace ringlet::bust_mesh_test
