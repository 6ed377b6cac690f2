// bodies/triangle_mesh.h, icosphere.h and distance_to_triangle.h: open edges are counted as they are made,
// and the closest place of a triangle is the closest.
#include "ringlet/bodies/triangle_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "tests/bodies/body_samples.h"

namespace ringlet::triangle_mesh_test {
namespace {

TEST(TriangleMesh, ClosedShapesAreWatertight) {
  EXPECT_TRUE(isWatertight(test::boxMesh({1, 2, 3})));
  EXPECT_TRUE(isWatertight(test::torusMesh(1, 0.3, 20, 10)));
  for (int frequency : {1, 2, 3, 7}) {
    const TriangleMesh mesh = makeIcosphere(frequency);
    EXPECT_TRUE(isWatertight(mesh));
    EXPECT_EQ(mesh.triangles.size(), 20u * frequency * frequency);
    EXPECT_EQ(mesh.points.size(), 10u * frequency * frequency + 2);  // Euler
    for (Vec3d p : mesh.points) EXPECT_NEAR(length(p), 1, 1e-15);
  }
}

TEST(TriangleMesh, CountsTheRimsOfHoles) {
  TriangleMesh mesh = test::boxMesh({1, 1, 1});
  mesh.triangles.pop_back();
  EXPECT_EQ(openEdgeCount(mesh), 3u);
  mesh.triangles.pop_back();
  EXPECT_EQ(openEdgeCount(mesh), 4u);
}

TEST(TriangleMesh, CountsEdgesThatDisagree) {
  TriangleMesh turned = test::boxMesh({1, 1, 1});
  std::swap(turned.triangles[0][1], turned.triangles[0][2]);
  EXPECT_EQ(openEdgeCount(turned), 3u);
  TriangleMesh fin = test::boxMesh({1, 1, 1});
  fin.points.push_back({5, 5, 5});
  fin.triangles.push_back({0, 1, 8});
  EXPECT_EQ(openEdgeCount(fin), 3u);  // two of its own, and the one with three triangles
  TriangleMesh twice = test::boxMesh({1, 1, 1});
  twice.triangles.insert(twice.triangles.end(), twice.triangles.begin(), twice.triangles.end());
  EXPECT_EQ(openEdgeCount(twice), 18u);
}

TEST(TriangleMesh, PointsAtOnePlaceAreOne) {
  // Every triangle with points of its own, zeros of either sign.
  const TriangleMesh shared = test::boxMesh({1, 1, 1});
  TriangleMesh split;
  for (const auto& t : shared.triangles) {
    const auto first = static_cast<std::uint32_t>(split.points.size());
    for (std::uint32_t i : t) {
      split.points.push_back(shared.points[i] - Vec3d{1, 1, 1});
      if (split.points.size() % 2 == 0 && split.points.back().x == 0) split.points.back().x = -0.0;
    }
    split.triangles.push_back({first, first + 1, first + 2});
  }
  split.points.push_back({std::numeric_limits<double>::quiet_NaN(), 0, 0});  // of no triangle
  EXPECT_TRUE(checkMesh(split));
  EXPECT_TRUE(isWatertight(split));
}

TEST(TriangleMesh, ChecksWhatItIsGiven) {
  EXPECT_FALSE(checkMesh({}));
  TriangleMesh mesh = test::boxMesh({1, 2, 3});
  EXPECT_TRUE(checkMesh(mesh));
  EXPECT_EQ(boundsOf(mesh), (Bounds{{-1, -2, -3}, {1, 2, 3}}));
  mesh.triangles[4][1] = 8;
  const Status index = checkMesh(mesh);
  ASSERT_FALSE(index);
  EXPECT_NE(index.error().message.find("triangle 4 of the mesh names point 8"), std::string::npos);
  mesh.triangles[4][1] = 5;
  mesh.points[5].y = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(checkMesh(mesh));
}

// Of a convex set, q is closest to p exactly if no corner v of it is ahead of q towards p.
TEST(DistanceToTriangle, FindsTheClosestPlace) {
  test::Places places(3, {-1, -1, -1}, {1, 1, 1});
  for (int i = 0; i < 20000; ++i) {
    const Vec3d a = places.next(), b = places.next(), c = places.next(), p = places.next() * 2;
    const Vec3d q = closestOnTriangle(p, a, b, c);
    for (Vec3d v : {a, b, c}) ASSERT_LE(dot(p - q, v - q), 1e-12) << i;
    // And it is on the triangle: the areas of the three parts make the whole.
    auto area = [](Vec3d u, Vec3d v, Vec3d w) { return length(cross(v - u, w - u)); };
    ASSERT_NEAR(area(q, a, b) + area(q, b, c) + area(q, c, a), area(a, b, c), 1e-12) << i;
  }
}

TEST(DistanceToTriangle, TakesTrianglesWithoutArea) {
  const Vec3d a{0, 0, 0}, b{1, 0, 0}, c{3, 0, 0};
  for (double x : {-1.0, 0.5, 1.0, 2.0, 2.5, 5.0}) {
    const Vec3d expected{std::clamp(x, 0.0, 3.0), 0, 0}, p{x, 1, 0};
    for (const auto& t : {std::array{a, b, c}, {b, c, a}, {c, a, b}, {b, a, c}, {a, c, b}, {c, b, a}})
      EXPECT_LE(length(closestOnTriangle(p, t[0], t[1], t[2]) - expected), 4e-16) << x;  // the last digit
    EXPECT_EQ(closestOnTriangle(p, a, a, a), a);
    EXPECT_EQ(closestOnTriangle(p, a, a, c), expected);
    EXPECT_EQ(closestOnTriangle(p, a, c, c), expected);
    EXPECT_EQ(closestOnTriangle(p, a, c, a), expected);
  }
}

TEST(DistanceToTriangle, TakesNeedles) {
  // All but a line: its edges are as near as its inside.
  test::Places places(4, {-1, -1, -1}, {1, 1, 1});
  for (int i = 0; i < 20000; ++i) {
    const Vec3d a = places.next(), c = places.next(), p = places.next() * 2;
    const Vec3d b = a + (c - a) * (0.5 + places.next().x * 0.8) + places.next() * std::pow(10.0, -9 - i % 10);
    auto toEdge = [&](Vec3d u, Vec3d v) {
      const double along = std::clamp(dot(p - u, v - u) / dot(v - u, v - u), 0.0, 1.0);
      return length(p - (u + (v - u) * along));
    };
    const double edges = std::min({toEdge(a, b), toEdge(b, c), toEdge(c, a)});
    ASSERT_NEAR(length(p - closestOnTriangle(p, a, b, c)), edges, 1e-8) << i;
  }
}

}  // namespace
}  // namespace ringlet::triangle_mesh_test
