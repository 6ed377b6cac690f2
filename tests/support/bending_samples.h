// Meshes that bend, at one time, with grids for the tests of mesh fields: watertight ones, with caps, of
// parts that overlap, cut by the grid, and of triangles far larger than cells.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "ringlet/bodies/close_mesh.h"
#include "ringlet/scene/bending_mesh.h"
#include "tests/bodies/body_samples.h"

namespace ringlet::test {

struct BendingSample {
  std::string name;
  BendingMesh mesh;
  std::vector<Vec3d> points;
};

inline Vec3d cornerPlace(const BendingMesh& mesh, std::size_t i) {
  const std::size_t row = mesh.counts[0] + 1, layer = row * (mesh.counts[1] + 1);
  return mesh.origin +
         Vec3d{double(i % row), double(i / row % (mesh.counts[1] + 1)), double(i / layer)} * mesh.cell;
}

/// `cells` along the longest side of the box.
inline BendingSample bendingSample(std::string name, const TriangleMesh& mesh, int cells, const Bounds& box) {
  BendingSample sample;
  sample.name = std::move(name);
  sample.mesh.surface = closed(mesh);
  sample.points = sample.mesh.surface.pointsOf(mesh.points);
  const Vec3d size = box.high - box.low;
  sample.mesh.cell = std::max({size.x, size.y, size.z}) / cells;
  sample.mesh.origin = box.low;
  const double sides[3] = {size.x, size.y, size.z};
  for (std::size_t axis = 0; axis < 3; ++axis)
    sample.mesh.counts[axis] =
        static_cast<std::uint32_t>(std::max(1.0, std::ceil(sides[axis] / sample.mesh.cell - 1e-9)));
  sample.mesh.reach = 0;
  const Vec3d middle = box.middle();
  for (const Vec3d p : sample.points)
    sample.mesh.reach = std::max(
        {sample.mesh.reach, std::abs(p.x - middle.x), std::abs(p.y - middle.y), std::abs(p.z - middle.z)});
  return sample;
}
inline BendingSample bendingSample(std::string name, const TriangleMesh& mesh, int cells) {
  Bounds box = boundsOf(mesh);
  const Vec3d room = Vec3d{1, 1, 1} * (box.diagonal() * 0.1);
  box.low = box.low - room, box.high += room;
  return bendingSample(std::move(name), mesh, cells, box);
}

inline std::vector<BendingSample> bendingSamples() {
  const TriangleMesh ball = sphereMesh(0.1, 6), box = boxMesh({0.1, 0.2, 0.05});
  std::vector<BendingSample> all;
  all.push_back(bendingSample("ball", ball, 16));
  all.push_back(bendingSample("ball of large triangles", sphereMesh(0.1, 1), 24));
  all.push_back(bendingSample("box", box, 16));
  all.push_back(bendingSample("torus", torusMesh(0.1, 0.03, 24, 12), 20));
  all.push_back(
      bendingSample("balls that overlap", together(ball, sphereMesh(0.07, 5, {0.08, 0.02, 0.03})), 18));
  TriangleMesh bowl = ball;
  std::erase_if(bowl.triangles, [&](const auto& t) {
    return std::ranges::all_of(t, [&](std::uint32_t p) { return ball.points[p].y > 0.02; });
  });
  all.push_back(bendingSample("bowl with a cap", bowl, 16));
  // Points on the lattice of corners, so that columns pass through corners and edges.
  all.push_back(
      bendingSample("box on the lattice", boxMesh({0.25, 0.5, 0.125}), 16, {{-1, -1, -1}, {1, 1, 1}}));
  // A tall body of which the grid holds the upper end, on no side all of it.
  const TriangleMesh tall = boxMesh({0.1, 2, 0.1});
  all.push_back(bendingSample("part of a tall box", tall, 16, {{-0.047, 1.803, -0.161}, {0.2, 2.1, 0.14}}));
  return all;
}

}  // namespace ringlet::test
