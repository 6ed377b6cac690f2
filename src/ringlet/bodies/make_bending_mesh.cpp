// Implements bodies/make_bending_mesh.h.
#include "ringlet/bodies/make_bending_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "ringlet/bodies/close_mesh.h"
#include "ringlet/bodies/cloth_tree.h"
#include "ringlet/bodies/mesh_grid.h"
#include "ringlet/scene/outside_numbers.h"

namespace ringlet {
namespace {

constexpr int kPadding = 3;           // cells about the part of the mesh that has a grid
constexpr int kFirstShapeCells = 32;  // of the grid of its first shape
constexpr double kFarther = 1.25;     // than where its points are said to come to

// A grid of cubes about a box.
void setGrid(const Bounds& box, int cells, BendingMesh& mesh) {
  const Vec3d size = box.high - box.low;
  mesh.cell = std::max({size.x, size.y, size.z}) / cells;
  const std::array<double, 3> sides{size.x, size.y, size.z};
  for (std::size_t axis = 0; axis < 3; ++axis)
    mesh.counts[axis] = static_cast<std::uint32_t>(std::ceil(sides[axis] / mesh.cell - 1e-9)) + 2 * kPadding;
  const Vec3d counts{double(mesh.counts[0]), double(mesh.counts[1]), double(mesh.counts[2])};
  mesh.origin = box.middle() - counts * (mesh.cell / 2);
}

double volumeOf(const std::vector<Vec3d>& points, const ClosedMesh& surface) {
  double six = 0;
  for (const auto& [a, b, c] : surface.triangles) six += dot(points[a], cross(points[b], points[c]));
  return six / 6;
}

Bounds widened(const Bounds& box, double share) {
  const Vec3d size = box.high - box.low;
  const Vec3d more = Vec3d{1, 1, 1} * (share * std::max({size.x, size.y, size.z}));
  return {box.low - more, box.high + more};
}

// One cell: the box in which it stays.
void makeCloth(const TriangleMesh& first, const Bounds& all, Body& body) {
  BendingMesh mesh;
  mesh.isCloth = true;
  mesh.points = first.points;
  mesh.surface.triangles = orderedAsTree(first.triangles, first.points);
  for (std::uint32_t i = 0; i < first.points.size(); ++i) mesh.surface.sources.push_back(i);
  const Vec3d size = all.high - all.low;
  mesh.cell = mesh.reach = kFarther * std::max({size.x, size.y, size.z});
  mesh.counts = {1, 1, 1};
  mesh.origin = all.middle() - Vec3d{1, 1, 1} * (mesh.cell / 2);
  body.grid = std::make_shared<const DistanceGrid>(
      DistanceGrid{mesh.origin, mesh.cell, mesh.counts, std::vector(8, static_cast<float>(mesh.cell))});
  body.thickness = std::max(body.thickness, kClothThickness);
  body.mesh = std::make_shared<const BendingMesh>(std::move(mesh));
}

}  // namespace

BendingRoom bendingRoomOf(std::span<const Vec3d> first, const std::optional<Bounds>& grid, int cells,
                          bool isCloth) {
  Bounds all = Bounds::none();
  for (const Vec3d p : first) all.add(p);
  const Bounds where = grid.value_or(widened(all, 0.25));
  all.add(where.low);
  all.add(where.high);
  return {where, widened(all, 1), cells, isCloth};
}

Status makeBendingMesh(TriangleMesh first, const BendingRoom& room, Body& body,
                       std::vector<std::string>& warnings) {
  if (Status checked = checkMesh(first); !checked) return checked;
  if (room.isCloth) {
    makeCloth(first, room.all, body);
    return {};
  }
  if (room.cells < 8 || room.cells > 256)
    return Error{
        fmt::format("a distance grid of {} cells along its longest side; expected 8 to 256", room.cells)};
  if (!room.grid.hasRoom() || !contains(kPosePlace, room.grid.low) || !contains(kPosePlace, room.grid.high))
    return Error{"a grid without room; expected its low corner below its high one along each axis"};
  BendingMesh mesh;
  mesh.surface = closed(first);
  if (volumeOf(mesh.surface.pointsOf(first.points), mesh.surface) < 0) {
    for (auto& triangle : first.triangles) std::swap(triangle[1], triangle[2]);
    mesh.surface = closed(first);
    warnings.push_back("the mesh is inside out, its triangles clockwise seen from outside; turned");
  }
  if (!mesh.surface.rims.empty())
    warnings.push_back(fmt::format("{} of its mesh's holes {} closed by caps that move with it",
                                   mesh.surface.rims.size(), mesh.surface.rims.size() == 1 ? "is" : "are"));
  mesh.points = first.points;
  setGrid(room.grid, room.cells, mesh);
  const Vec3d middle = room.grid.middle();
  const Bounds& all = room.all;
  mesh.reach = kFarther * std::max({all.high.x - middle.x, middle.x - all.low.x, all.high.y - middle.y,
                                    middle.y - all.low.y, all.high.z - middle.z, middle.z - all.low.z});
  auto grid = makeDistanceGrid(first, {.cells = std::min(room.cells, kFirstShapeCells)});
  if (!grid) return grid.error();
  body.grid = std::make_shared<const DistanceGrid>(std::move(grid->grid));
  body.mesh = std::make_shared<const BendingMesh>(std::move(mesh));
  return {};
}

}  // namespace ringlet
