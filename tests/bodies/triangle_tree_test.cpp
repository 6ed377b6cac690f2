// bodies/triangle_tree.h against sums over all triangles, and winding numbers against closed forms.
#include "ringlet/bodies/triangle_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "ringlet/bodies/mesh_file.h"
#include "tests/bodies/body_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::triangle_tree_test {
namespace {

void expectBruteDistances(const TriangleMesh& mesh, int count) {
  const Bounds bounds = boundsOf(mesh);
  const Vec3d size = bounds.high - bounds.low;
  test::Places places(5, bounds.low - size / 2, bounds.high + size / 2);
  const TriangleTree tree(mesh);
  TriangleTree::Nearest nearest{0, 0};
  for (int i = 0; i < count; ++i) {
    const Vec3d p = places.next();
    nearest = tree.nearest(p, nearest.entry);  // a useless guess, from another place
    ASSERT_EQ(nearest.distance, test::bruteDistance(mesh, p)) << "place " << i;
    ASSERT_EQ(tree.nearest(p).distance, nearest.distance);
  }
}

TEST(TriangleTree, DistancesAreThoseOfAllTriangles) {
  expectBruteDistances(makeIcosphere(1), 2000);
  expectBruteDistances(test::torusMesh(0.1, 0.03, 60, 20), 1000);
  TriangleMesh one;
  one.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}};
  one.triangles = {{0, 1, 2}};
  expectBruteDistances(one, 1000);
  // Many triangles in one place cannot be parted.
  for (int i = 0; i < 100; ++i) one.triangles.push_back({0, 1, 2});
  expectBruteDistances(one, 100);
}

TEST(TriangleTree, DistancesOfARealHead) {
  RINGLET_NEEDS_DATA(path, "sintel/sintel.obj");
  const Result<TriangleMesh> mesh = readObjMesh(path, 1);
  ASSERT_TRUE(mesh) << mesh.error().message;
  expectBruteDistances(*mesh, 500);
}

TEST(TriangleTree, WindingNumbersAreThoseOfAllTriangles) {
  TriangleMesh open = test::torusMesh(0.1, 0.03, 60, 20);
  open.triangles.resize(1700);
  for (const TriangleMesh& mesh : {test::sphereMesh(0.1, 8), open}) {
    test::Places places(9, {-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2});
    const TriangleTree tree(mesh);
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3d p = places.next();
      worst = std::max(worst, std::abs(tree.windingNumber(p) - test::bruteWinding(mesh, p)));
    }
    std::printf("dipoles err by %.4f at most\n", worst);
    EXPECT_LT(worst, 0.03);
  }
}

TEST(TriangleTree, WindingNumbersHaveClosedForms) {
  // A face of a cube covers a sixth of all directions from its middle.
  TriangleMesh box = test::boxMesh({1, 1, 1});
  EXPECT_NEAR(TriangleTree(box).windingNumber({}), 1, 1e-12);
  box.triangles.resize(10);
  EXPECT_NEAR(TriangleTree(box).windingNumber({}), 5.0 / 6, 1e-12);
  box.triangles.resize(2);
  EXPECT_NEAR(TriangleTree(box).windingNumber({}), 1.0 / 6, 1e-12);

  // Within both, within one, within none, within a hollow, and inside out.
  const TriangleMesh both = test::together(test::sphereMesh(1, 10), test::sphereMesh(1, 10, {1, 0, 0}));
  const TriangleTree tree(both);
  EXPECT_NEAR(tree.windingNumber({0.5, 0, 0}), 2, 0.03);
  EXPECT_NEAR(tree.windingNumber({-0.5, 0, 0}), 1, 0.03);
  EXPECT_NEAR(tree.windingNumber({0.5, 2, 0}), 0, 0.03);
  TriangleMesh core = test::sphereMesh(0.5, 10);
  test::turnInsideOut(core);
  EXPECT_NEAR(TriangleTree(core).windingNumber({0.1, 0.1, 0}), -1, 0.03);
  const TriangleTree hollow(test::together(test::sphereMesh(1, 10), core));
  EXPECT_NEAR(hollow.windingNumber({0.1, 0.1, 0}), 0, 0.03);
  EXPECT_NEAR(hollow.windingNumber({0.7, 0.1, 0}), 1, 0.03);
}

}  // namespace
}  // namespace ringlet::triangle_tree_test
