// bodies/body_surface.h: closed surfaces that lie on the body and face out, of every shape that has an end.
#include "ringlet/bodies/body_surface.h"

#include <gtest/gtest.h>

#include <memory>

#include "ringlet/bodies/body_distance.h"
#include "ringlet/bodies/icosphere.h"
#include "ringlet/bodies/mesh_grid.h"

namespace ringlet::body_surface_test {
namespace {

struct Case {
  const char* name;
  Body body;
  double off;     // of the surface's points and of its triangles' middles at most [m]
  double volume;  // [m^3]
  double share;   // of it that may be missing
};

std::vector<Case> cases() {
  constexpr double kPi = 3.14159265358979;
  std::vector<Case> all;
  all.push_back({"sphere", {.shape = BodyShape::sphere, .radius = 0.1}, 2e-4, 4.0 / 3 * kPi * 1e-3, 0.005});
  all.push_back({"capsule",
                 {.shape = BodyShape::capsule, .radius = 0.05, .length = 0.2},
                 2e-3,
                 4.0 / 3 * kPi * 1.25e-4 + kPi * 2.5e-3 * 0.2,
                 0.01});
  all.push_back({"box", {.shape = BodyShape::box, .halfExtents = {0.1, 0.2, 0.3}}, 1e-12, 0.048, 1e-12});
  TriangleMesh egg = makeIcosphere(12);
  for (Vec3d& p : egg.points) p = Vec3d{0.1 * p.x + 0.3, 0.15 * p.y, 0.08 * p.z};
  Body grid;
  grid.shape = BodyShape::grid;
  grid.grid = std::make_shared<const DistanceGrid>(makeDistanceGrid(egg, {.cells = 40})->grid);
  all.push_back({"grid", grid, 2e-3, 4.0 / 3 * kPi * 0.1 * 0.15 * 0.08, 0.02});
  return all;
}

TEST(BodySurface, IsClosedOnTheBodyAndFacesOut) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const TriangleMesh mesh = surfaceOf(c.body);
    ASSERT_TRUE(checkMesh(mesh));
    EXPECT_EQ(openEdgeCount(mesh), 0u);
    double volume = 0;
    for (const auto& [i, j, k] : mesh.triangles) {
      const Vec3d &a = mesh.points[i], &b = mesh.points[j], &d = mesh.points[k];
      volume += dot(a, cross(b, d)) / 6;
      EXPECT_LT(std::abs(distanceTo(c.body, (a + b + d) / 3.0)), c.off);
      EXPECT_LT(std::abs(distanceTo(c.body, a)), c.off);
    }
    EXPECT_NEAR(volume / c.volume, 1, c.share) << "and above 0: it faces out";
  }
}

TEST(BodySurface, APlaneHasNone) { EXPECT_TRUE(surfaceOf({.shape = BodyShape::plane}).triangles.empty()); }

}  // namespace
}  // namespace ringlet::body_surface_test
