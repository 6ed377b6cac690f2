// bodies/mesh_grid.h: grids of meshes against closed forms, the sign beside every point of made and of real
// meshes, and what becomes of holes, overlaps, unconnected triangles and meshes that are inside out.
#include "ringlet/bodies/mesh_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <string>

#include "ringlet/bodies/grid_sample.h"
#include "ringlet/bodies/mesh_file.h"
#include "ringlet/bodies/triangle_tree.h"
#include "tests/bodies/body_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::mesh_grid_test {
namespace {

using Distance = std::function<double(Vec3d)>;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

MeshGrid gridOf(const TriangleMesh& mesh, const MeshGridSettings& settings = {}) {
  Result<MeshGrid> made = makeDistanceGrid(mesh, settings);
  EXPECT_TRUE(made) << (made ? "" : made.error().message);
  return made ? *made : MeshGrid{};
}

// The largest error of sampled distances, in cells, at random places within `reach` cells of the surface.
double worstError(const DistanceGrid& grid, const Distance& distance, double reach) {
  const Vec3d size =
      Vec3d{double(grid.counts[0]), double(grid.counts[1]), double(grid.counts[2])} * grid.cell;
  test::Places places(7, grid.origin, grid.origin + size);
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const Vec3d p = places.next();
    if (std::abs(distance(p)) > reach * grid.cell) continue;
    worst = std::max(worst, std::abs(sampleGrid(grid, p).distance - distance(p)));
  }
  return worst / grid.cell;
}

// How many points, moved by a cell along their normal, are not on that side.
int wrongSides(const TriangleMesh& mesh, const DistanceGrid& grid) {
  const std::vector<Vec3d> normals = test::pointNormals(mesh);
  int wrong = 0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    wrong += sampleGrid(grid, mesh.points[i] + normals[i] * grid.cell).distance <= 0;
    wrong += sampleGrid(grid, mesh.points[i] - normals[i] * grid.cell).distance >= 0;
  }
  return wrong;
}

TEST(MeshGrid, IsWhatFormulasSay) {
  const Vec3d half{0.07, 0.1, 0.05};
  struct Case {
    const char* name;
    TriangleMesh mesh;
    Distance distance;
  };
  for (const Case& c : {Case{"sphere", test::sphereMesh(0.1, 17), [](Vec3d p) { return length(p) - 0.1; }},
                        Case{"box", test::boxMesh(half), [&](Vec3d p) { return test::boxDistance(p, half); }},
                        Case{"torus", test::torusMesh(0.1, 0.03, 120, 40),
                             [](Vec3d p) { return test::torusDistance(p, 0.1, 0.03); }}}) {
    const MeshGrid made = gridOf(c.mesh);
    EXPECT_EQ(made.openEdges, 0u);
    EXPECT_TRUE(made.warnings.empty());
    const double near = worstError(made.grid, c.distance, 3),
                 everywhere = worstError(made.grid, c.distance, 1e9);
    std::printf("%s: within 3 cells an error of %.3f cells at most, everywhere %.3f\n", c.name, near,
                everywhere);
    EXPECT_LT(near, 0.5) << c.name;
    EXPECT_LT(everywhere, std::sqrt(0.75)) << c.name;  // half a cell's diagonal, at the tips of ridges
    EXPECT_EQ(wrongSides(c.mesh, made.grid), 0) << c.name;
  }
}

TEST(MeshGrid, IsAsLargeAsAskedFor) {
  const TriangleMesh mesh = test::boxMesh({0.05, 0.1, 0.02});
  for (int cells : {8, 20, 33}) {
    for (int padding : {1, 5}) {
      const DistanceGrid grid = gridOf(mesh, {.cells = cells, .padding = padding}).grid;
      EXPECT_NEAR(grid.cell, 0.2 / cells, 1e-12);
      EXPECT_EQ(grid.counts[1], unsigned(cells + 2 * padding));
      EXPECT_EQ(grid.distances.size(),
                (grid.counts[0] + 1u) * std::size_t{grid.counts[1] + 1} * (grid.counts[2] + 1));
      const Vec3d high =
          grid.origin +
          Vec3d{double(grid.counts[0]), double(grid.counts[1]), double(grid.counts[2])} * grid.cell;
      EXPECT_LT(length(grid.origin + high), 1e-12) << "the mesh is in the middle";
      EXPECT_GE(high.x, 0.05 + padding * grid.cell - 1e-9);
      EXPECT_GE(high.z, 0.02 + padding * grid.cell - 1e-9);
    }
  }
}

TEST(MeshGrid, CornersAreExactFarFromTheSurfaceToo) {
  // Places away from the row's first corner get their sign by going along; here each is looked at by itself.
  const TriangleMesh mesh = test::together(test::torusMesh(0.1, 0.03, 40, 12), test::sphereMesh(0.04, 4));
  const DistanceGrid grid = gridOf(mesh, {.cells = 16}).grid;
  for (std::uint32_t z = 0; z <= grid.counts[2]; ++z) {
    for (std::uint32_t y = 0; y <= grid.counts[1]; ++y) {
      for (std::uint32_t x = 0; x <= grid.counts[0]; ++x) {
        const Vec3d p = grid.origin + Vec3d{double(x), double(y), double(z)} * grid.cell;
        const double magnitude = test::bruteDistance(mesh, p);
        const double expected = test::bruteWinding(mesh, p) > 0.5 ? -magnitude : magnitude;
        if (magnitude < 1e-9) continue;
        ASSERT_NEAR(double{grid.distances[grid.cornerIndex(x, y, z)]}, expected, 1e-7)
            << x << ' ' << y << ' ' << z;
      }
    }
  }
}

TEST(MeshGrid, DoesNotDependOnThreads) {
  TriangleMesh mesh = test::torusMesh(0.1, 0.03, 60, 20);
  for (int round = 0; round < 2; ++round) {
    const DistanceGrid one = gridOf(mesh, {.cells = 32, .threadCount = 1}).grid;
    for (int threads : {0, 2, 3, 100})
      EXPECT_EQ(gridOf(mesh, {.cells = 32, .threadCount = threads}).grid.distances, one.distances);
    mesh.triangles.resize(2000);  // and with a hole
  }
}

TEST(MeshGrid, TurnsWhatIsInsideOut) {
  TriangleMesh mesh = test::sphereMesh(0.1, 10);
  const MeshGrid right = gridOf(mesh, {.cells = 32});
  test::turnInsideOut(mesh);
  const MeshGrid turned = gridOf(mesh, {.cells = 32});
  ASSERT_EQ(turned.warnings.size(), 1u);
  EXPECT_TRUE(contains(turned.warnings[0], "inside out")) << turned.warnings[0];
  ASSERT_EQ(turned.grid.distances.size(), right.grid.distances.size());
  for (std::size_t i = 0; i < right.grid.distances.size(); ++i)
    ASSERT_NEAR(turned.grid.distances[i], right.grid.distances[i], 1e-7f);
}

TEST(MeshGrid, WarnsOfPartsThatAreInsideOut) {
  TriangleMesh small = test::sphereMesh(0.03, 6, {0.2, 0, 0});
  test::turnInsideOut(small);
  const MeshGrid made = gridOf(test::together(test::sphereMesh(0.1, 10), small));
  ASSERT_EQ(made.warnings.size(), 1u);
  EXPECT_TRUE(contains(made.warnings[0], "a part of the mesh is inside out")) << made.warnings[0];
  EXPECT_LT(sampleGrid(made.grid, {0, 0, 0}).distance, 0);
  EXPECT_GT(sampleGrid(made.grid, {0.2, 0, 0}).distance, 0);
  // A hollow is inside out too, and right.
  TriangleMesh core = test::sphereMesh(0.05, 6);
  test::turnInsideOut(core);
  const MeshGrid hollow = gridOf(test::together(test::sphereMesh(0.1, 10), core));
  EXPECT_TRUE(hollow.warnings.empty());
  EXPECT_GT(sampleGrid(hollow.grid, {0, 0, 0}).distance, 0);
  EXPECT_LT(sampleGrid(hollow.grid, {0.075, 0, 0}).distance, 0);
}

TEST(MeshGrid, PartsThatOverlapAreOneBody) {
  const Vec3d aside{0.1, 0, 0};
  const MeshGrid made = gridOf(test::together(test::sphereMesh(0.1, 12), test::sphereMesh(0.1, 12, aside)));
  EXPECT_EQ(made.openEdges, 0u);
  EXPECT_TRUE(made.warnings.empty());
  test::Places places(11, {-0.13, -0.13, -0.13}, {0.23, 0.13, 0.13});
  for (int i = 0; i < 20000; ++i) {
    const Vec3d p = places.next();
    const double distance = std::min(length(p) - 0.1, length(p - aside) - 0.1);
    const double sampled = sampleGrid(made.grid, p).distance;
    if (distance > 0) {
      ASSERT_LE(sampled, distance + 0.6 * made.grid.cell);
    }
    if (distance > 0 && distance < 3 * made.grid.cell) {
      ASSERT_GE(sampled, distance - 0.6 * made.grid.cell);
    }
    // Deep inside, the other part's surface makes it shallow, not outside.
    if (distance < -made.grid.cell) {
      ASSERT_LT(sampled, 0);
    }
  }
}

// A ball without its cap above y: what is left is convex, closed by a flat film.
TriangleMesh openSphere(double radius, int frequency, double y) {
  TriangleMesh mesh = test::sphereMesh(radius, frequency);
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return mesh.points[t[0]].y > y && mesh.points[t[1]].y > y && mesh.points[t[2]].y > y;
  });
  // Flat: the rim's points come down onto the plane.
  for (Vec3d& p : mesh.points) {
    if (p.y <= y) continue;
    const double around = std::sqrt(radius * radius - y * y);
    p = normalizedOr(Vec3d{p.x, 0, p.z}, Vec3d{}) * around + Vec3d{0, y, 0};
  }
  return mesh;
}

TEST(MeshGrid, ClosesAHoleByAFilm) {
  constexpr double kRadius = 0.1;
  for (double y : {0.09, 0.06, 0.0}) {
    const TriangleMesh mesh = openSphere(kRadius, 17, y);
    const MeshGrid made = gridOf(mesh, {.cells = 40});
    EXPECT_GT(made.openEdges, 10u);
    ASSERT_EQ(made.warnings.size(), 1u);
    EXPECT_TRUE(contains(made.warnings[0], "not watertight: " + std::to_string(made.openEdges) + " edges"))
        << made.warnings[0];
    // The nearest place of the cut ball: on the cap's plane, on its rim or on the sphere.
    const double rim = std::sqrt(kRadius * kRadius - y * y);
    const Distance distance = [&](Vec3d p) {
      const double around = std::hypot(p.x, p.z), toRim = std::hypot(around - rim, p.y - y);
      const bool isInside = length(p) < kRadius && p.y < y;
      const double toFilm = around < rim ? std::abs(p.y - y) : toRim;
      const bool isBelow =
          length(p) == 0 || p.y / length(p) < y / kRadius;  // its nearest place is on the sphere
      const double toSphere = isBelow ? std::abs(length(p) - kRadius) : toRim;
      return isInside ? -std::min(toFilm, toSphere) : std::min(toFilm, toSphere);
    };
    const double near = worstError(made.grid, distance, 3), everywhere = worstError(made.grid, distance, 1e9);
    std::printf("hole at %.2f: within 3 cells an error of %.3f cells at most, everywhere %.3f\n", y, near,
                everywhere);
    EXPECT_LT(near, 1);
    EXPECT_LT(everywhere, 1.5);
  }
}

TEST(MeshGrid, TrianglesNeedNotBeConnected) {
  // Every triangle by itself, a little smaller than its hole.
  const TriangleMesh shared = test::sphereMesh(0.1, 12);
  TriangleMesh soup;
  for (const auto& t : shared.triangles) {
    const Vec3d a = shared.points[t[0]], b = shared.points[t[1]], c = shared.points[t[2]],
                m = (a + b + c) / 3;
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    for (Vec3d p : {a, b, c}) soup.points.push_back(m + (p - m) * 0.98);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  const MeshGrid made = gridOf(soup);
  EXPECT_EQ(made.openEdges, 3 * soup.triangles.size());
  EXPECT_LT(worstError(
                made.grid, [](Vec3d p) { return length(p) - 0.1; }, 3),
            0.5);
}

TEST(MeshGrid, SaysWhatIsWrong) {
  const TriangleMesh mesh = test::boxMesh({0.1, 0.1, 0.1});
  const auto expectError = [](const TriangleMesh& m, const MeshGridSettings& settings, const char* part) {
    const Result<MeshGrid> made = makeDistanceGrid(m, settings);
    ASSERT_FALSE(made) << part;
    EXPECT_TRUE(contains(made.error().message, part)) << made.error().message;
  };
  expectError(mesh, {.cells = 7}, "7 cells along its longest side; expected 8 to 256");
  expectError(mesh, {.cells = 257}, "257 cells");
  expectError(mesh, {.padding = 0}, "0 cells of room");
  expectError(mesh, {.padding = 17}, "17 cells of room");
  expectError(mesh, {.threadCount = -1}, "-1 threads");
  expectError({}, {}, "no triangles");
  TriangleMesh point = mesh;
  for (Vec3d& p : point.points) p = {};
  expectError(point, {}, "0 m from corner to corner");
  TriangleMesh huge = mesh;
  for (Vec3d& p : huge.points) p = p * 1e200;
  expectError(huge, {}, "is its unit right?");
  TriangleMesh sheet = mesh;
  sheet.triangles.resize(2);
  expectError(sheet, {}, "has no inside that a grid of cells of");
}

TEST(MeshGrid, OfARealColliderHasEverySideRight) {
  RINGLET_NEEDS_DATA(path, "sintel/sintel-collider.obj");
  const Result<TriangleMesh> mesh = readObjMesh(path, 1);
  ASSERT_TRUE(mesh) << mesh.error().message;
  const MeshGrid made = gridOf(*mesh);
  EXPECT_EQ(made.openEdges, 0u);
  EXPECT_TRUE(made.warnings.empty());
  EXPECT_EQ(wrongSides(*mesh, made.grid), 0);
}

TEST(MeshGrid, OfARealHeadWithHoles) {
  RINGLET_NEEDS_DATA(path, "sintel/sintel.obj");
  const Result<TriangleMesh> mesh = readObjMesh(path, 1);
  ASSERT_TRUE(mesh) << mesh.error().message;
  const MeshGrid made = gridOf(*mesh, {.threadCount = 1});

  // A cell of 7 mm is thicker than lids, lips and ears: a place a cell away along the normal may be beyond
  // the next surface. So each is judged by all triangles' solid angles, where it is a cell's diagonal from
  // them, and three cells from the rims of holes, across which the film has its own mind about a distance.
  const std::vector<Vec3d> rims = test::openRims(*mesh);
  const std::vector<Vec3d> normals = test::pointNormals(*mesh);
  int onOtherSide = 0, rightly = 0, wrong = 0, wrongAtRims = 0, judged = 0;
  for (std::size_t i = 0; i < mesh->points.size(); i += 4) {  // all take ten seconds
    for (double side : {1.0, -1.0}) {
      const Vec3d p = mesh->points[i] + normals[i] * (side * made.grid.cell);
      const bool isInside = test::bruteWinding(*mesh, p) > 0.5;
      const bool saysInside = sampleGrid(made.grid, p).distance < 0;
      onOtherSide += saysInside == (side > 0);
      rightly += saysInside == (side > 0) && isInside == saysInside;
      if (test::bruteDistance(*mesh, p) < 0.87 * made.grid.cell) continue;
      const bool isAtRim =
          std::ranges::any_of(rims, [&](Vec3d r) { return length(p - r) < 3 * made.grid.cell; });
      ++judged;
      (isAtRim ? wrongAtRims : wrong) += isInside != saysInside;
    }
  }
  std::printf("%zu triangles, %zu corners\n", mesh->triangles.size(), made.grid.distances.size());
  std::printf(
      "of %zu places a cell beside its points %d are on the other side, %d of them beyond another surface; "
      "of %d well away from all surfaces %d are wrong, and %d at rims\n",
      (mesh->points.size() + 3) / 4 * 2, onOtherSide, rightly, judged, wrong, wrongAtRims);
  EXPECT_GT(judged, 900);
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(made.openEdges, 148u);  // mouth, eyes, neck and both arms, as the file's own edges say
  ASSERT_EQ(made.warnings.size(), 1u);
}

}  // namespace
}  // namespace ringlet::mesh_grid_test
