// Implements groom/scalp.h.
#include "ringlet/groom/scalp.h"

#include <array>
#include <utility>

#include "ringlet/bodies/bounds.h"
#include "ringlet/bodies/distance_to_triangle.h"
#include "ringlet/bodies/grid_sample.h"
#include "ringlet/bodies/mesh_grid.h"
#include "ringlet/bodies/triangle_tree.h"

namespace ringlet {

struct Scalp::Mesh {
  TriangleMesh triangles;
  TriangleTree tree;
  DistanceGrid grid;
  double reach = 0;  // no point is further from the origin [m]

  Vec3d nearest(Vec3d place) const {
    const auto& [a, b, c] = triangles.triangles[tree.nearest(place).triangle];
    const Vec3d corners[] = {triangles.points[a], triangles.points[b], triangles.points[c]};
    const std::array<double, 3> shares = closestShares(place, corners[0], corners[1], corners[2]);
    return corners[0] * shares[0] + corners[1] * shares[1] + corners[2] * shares[2];
  }
};

// Beyond its grid heights are too small, so that hair would be raised too far: a third of a head reaches
// further than hair is lifted.
constexpr MeshGridSettings kGrid{.cells = 48, .padding = 16};

Result<Scalp> Scalp::of(const TriangleMesh& mesh) {
  auto grid = makeDistanceGrid(mesh, kGrid);
  if (!grid) return grid.error();
  double reach = 0;
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t point : triangle) reach = std::max(reach, length(mesh.points[point]));
  Scalp scalp(0);
  scalp.mesh_ = std::make_shared<const Mesh>(Mesh{mesh, TriangleTree(mesh), std::move(grid->grid), reach});
  return scalp;
}

std::optional<ScalpRoot> Scalp::rootAlong(Vec3d direction) const {
  if (!mesh_) return ScalpRoot{direction, direction * radius_, direction};
  // No step is longer than the surface is away, nor shorter than what the grid is good to.
  const double cell = mesh_->grid.cell, least = 0.02 * cell;
  double far = mesh_->reach + cell;
  while (far > 0) {
    const double height = heightOf(direction * far).height;
    if (height < least) break;
    far -= height;
  }
  if (far <= 0) return std::nullopt;
  // The grid closes holes; no hair grows there.
  const Vec3d position = mesh_->nearest(direction * far);
  if (length(position - direction * far) > cell) return std::nullopt;
  return ScalpRoot{normalizedOr(position, direction), position, heightOf(position).outward};
}

ScalpHeight Scalp::heightOf(Vec3d place) const {
  if (!mesh_) return {length(place) - radius_, normalizedOr(place, Vec3d{0, 1, 0})};
  const GridSample sample = sampleGrid(mesh_->grid, place);
  return {sample.distance, sample.direction};
}

Vec3d Scalp::raisedTo(Vec3d place, double height) const {
  const ScalpHeight now = heightOf(place);
  if (!mesh_) return now.outward * (radius_ + height);
  return place + now.outward * (height - now.height);
}

}  // namespace ringlet
