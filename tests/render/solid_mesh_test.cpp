// Bodies in pictures: patches stand for the surface, however coarse its triangles are.
#include "ringlet/render/solid_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ringlet/bodies/icosphere.h"

namespace ringlet::solid_mesh_test {
namespace {

double areaOf(const TriangleMesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles)
    area += length(cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]])) / 2;
  return area;
}

TEST(SolidMesh, PatchesHaveTheSurfacesArea) {
  TriangleMesh ball = makeIcosphere(3);
  for (Vec3d& p : ball.points) p = p * 0.1;
  for (const TriangleMesh& mesh : {ball, squareOf(0.3)}) {
    const SolidMesh solid = solidMeshOf(mesh, 0.01);
    double area = 0;
    for (const SolidMesh::Patch& patch : solid.patches) {
      EXPECT_GT(patch.area, 0);
      EXPECT_LT(patch.area, 2e-4);
      area += patch.area;
    }
    EXPECT_NEAR(area, areaOf(mesh), 1e-12);
    EXPECT_EQ(solid.points.size(), mesh.points.size());
    EXPECT_EQ(solid.triangles, mesh.triangles);
  }
}

TEST(SolidMesh, NormalsPointOut) {
  const SolidMesh solid = solidMeshOf(makeIcosphere(4), 0.1);
  for (std::size_t i = 0; i < solid.points.size(); ++i)
    EXPECT_GT(dot(solid.normals[i], solid.points[i]), 0.99);
  for (const SolidMesh::Patch& patch : solid.patches)
    EXPECT_GT(dot(patch.normal, normalizedOr(patch.place, {})), 0.97);
}

TEST(SolidMesh, LargeBodiesHaveBoundedNumbersOfPatches) {
  const SolidMesh solid = solidMeshOf(squareOf(50), 0.004);
  EXPECT_GT(solid.patches.size(), 10000u);
  EXPECT_LT(solid.patches.size(), 150000u);
}

}  // namespace
}  // namespace ringlet::solid_mesh_test
