// bodies/close_mesh.h: whatever holes a mesh has, its caps leave none, and they move with their rims.
#include "ringlet/bodies/close_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <string>

#include "tests/bodies/body_samples.h"

namespace ringlet::test::close_mesh_test {
namespace {

struct Sample {
  std::string name;
  TriangleMesh mesh;
  std::size_t caps;
};

TriangleMesh without(TriangleMesh mesh, const std::function<bool(std::size_t)>& isLeftOut) {
  std::size_t t = 0;
  std::erase_if(mesh.triangles, [&](const auto&) { return isLeftOut(t++); });
  return mesh;
}

bool isAbove(const TriangleMesh& mesh, std::size_t t, double y) {
  return std::ranges::all_of(mesh.triangles[t], [&](std::uint32_t p) { return mesh.points[p].y > y; });
}

// Each triangle with corners of its own, as files with seams at every edge have them.
TriangleMesh torn(const TriangleMesh& mesh) {
  TriangleMesh apart;
  for (const auto& triangle : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(apart.points.size());
    for (const std::uint32_t p : triangle) apart.points.push_back(mesh.points[p]);
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  return apart;
}

std::vector<Sample> samples() {
  const TriangleMesh ball = sphereMesh(0.1, 6), box = boxMesh({0.1, 0.2, 0.05});
  std::vector<Sample> all;
  all.push_back({"ball", ball, 0});
  all.push_back({"torn ball", torn(ball), 0});
  all.push_back({"bowl", without(ball, [&](std::size_t t) { return isAbove(ball, t, 0.02); }), 1});
  all.push_back({"torn bowl", torn(all.back().mesh), 1});
  all.push_back(
      {"tube",
       without(ball, [&](std::size_t t) { return isAbove(ball, t, 0.04) || !isAbove(ball, t, -0.06); }), 2});
  // Two holes that meet in a point.
  const std::uint32_t corner = ball.triangles[0][0];
  std::size_t met = 0;
  all.push_back({"two holes at a point",
                 without(ball,
                         [&](std::size_t t) {
                           return std::ranges::find(ball.triangles[t], corner) != ball.triangles[t].end() &&
                                  ++met % 2 == 1;
                         }),
                 2});  // of five triangles around it two are left, apart
  all.push_back({"box without a triangle", without(box, [](std::size_t t) { return t == 4; }), 1});
  all.push_back({"a triangle", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, 1});
  // A wing on an edge that two triangles have already.
  TriangleMesh winged = box;
  winged.points.push_back({0.3, 0.3, 0});
  winged.triangles.push_back({0, 2, 8});
  all.push_back({"winged box", winged, 1});
  return all;
}

TEST(CloseMesh, HasNoHoles) {
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    const ClosedMesh made = closed(sample.mesh);
    EXPECT_EQ(made.rims.size(), sample.caps);
    const TriangleMesh own{made.pointsOf(sample.mesh.points), made.triangles};
    ASSERT_EQ(own.points.size(), made.pointCount());
    ASSERT_TRUE(checkMesh(own));
    // Every place is inside a whole number of times.
    const Bounds bounds = boundsOf(own);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> share(-0.1, 1.1);
    for (int i = 0; i < 200; ++i) {
      const Vec3d size = bounds.high - bounds.low;
      const Vec3d p =
          bounds.low + Vec3d{size.x * share(random), size.y * share(random), size.z * share(random)};
      const double winding = bruteWinding(own, p);
      EXPECT_NEAR(winding, std::round(winding), 1e-9);
    }
  }
}

TEST(CloseMesh, KeepsTheMeshItself) {
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    const ClosedMesh made = closed(sample.mesh);
    const std::vector<Vec3d> points = made.pointsOf(sample.mesh.points);
    ASSERT_GE(made.triangles.size(), sample.mesh.triangles.size());
    for (std::size_t t = 0; t < sample.mesh.triangles.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_EQ(points[made.triangles[t][c]], sample.mesh.points[sample.mesh.triangles[t][c]]);
  }
}

TEST(CloseMesh, CapsMoveWithTheirRims) {
  const TriangleMesh ball = sphereMesh(0.1, 6);
  const TriangleMesh bowl = without(ball, [&](std::size_t t) { return isAbove(ball, t, 0.02); });
  const ClosedMesh made = closed(bowl);
  const Vec3d before = made.pointsOf(bowl.points).back();
  std::vector<Vec3d> moved = bowl.points;
  for (Vec3d& p : moved) p = Vec3d{p.z, p.x, p.y} * 2 + Vec3d{1, 2, 3};
  const Vec3d after = made.pointsOf(moved).back();
  EXPECT_LT(length(after - (Vec3d{before.z, before.x, before.y} * 2 + Vec3d{1, 2, 3})), 1e-12);
}

// Lips that touch part later: points that no open edge has stay by themselves.
TEST(CloseMesh, ClosedPartsAtOnePlaceStayApart) {
  TriangleMesh two = boxMesh({0.1, 0.1, 0.1});
  const TriangleMesh other = two;
  for (const Vec3d p : other.points) two.points.push_back(p + Vec3d{0.2, 0, 0});
  for (auto [a, b, c] : other.triangles) two.triangles.push_back({a + 8, b + 8, c + 8});
  const ClosedMesh made = closed(two);
  EXPECT_EQ(made.sources.size(), 16u);
  EXPECT_TRUE(made.rims.empty());
}

}  // namespace
}  // namespace ringlet::test::close_mesh_test
