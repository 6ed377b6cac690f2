// Implements bodies/body_surface.h.
#include "ringlet/bodies/body_surface.h"

#include <array>
#include <cstdint>
#include <utility>

#include "ringlet/bodies/icosphere.h"

namespace ringlet {
namespace {

constexpr int kRound = 16;  // parts of an icosahedron's edge: chords are within 0.001 of the radius

TriangleMesh roundSurface(double radius, double length) {
  TriangleMesh mesh = makeIcosphere(kRound);
  for (Vec3d& point : mesh.points) {
    const double shift = point.y > 0 ? length / 2 : point.y < 0 ? -length / 2 : 0;
    point = point * radius + Vec3d{0, shift, 0};
  }
  return mesh;
}

// Each face has four points of its own, so that edges stay sharp.
TriangleMesh boxSurface(Vec3d half) {
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const auto first = static_cast<std::uint32_t>(mesh.points.size());
      for (const auto& [u, v] : {std::pair(-1.0, -side), {1.0, -side}, {1.0, side}, {-1.0, side}}) {
        const Vec3d corner = axis == 0   ? Vec3d{side, u, v}
                             : axis == 1 ? Vec3d{v, side, u}
                                         : Vec3d{u, v, side};
        mesh.points.push_back({corner.x * half.x, corner.y * half.y, corner.z * half.z});
      }
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
  }
  return mesh;
}

// Surface nets over the cells of a grid.
class SurfaceNets {
 public:
  explicit SurfaceNets(const DistanceGrid& grid) : grid_(grid), pointOf_(grid.cellCount(), kNone) {}

  TriangleMesh make() {
    forEachCell([this](Cell cell) { placePoint(cell); });
    forEachCell([this](Cell cell) {
      for (int axis = 0; axis < 3; ++axis) placeFace(cell, axis);
    });
    return std::move(mesh_);
  }

 private:
  using Cell = std::array<std::uint32_t, 3>;
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  void forEachCell(auto&& visit) {
    for (std::uint32_t z = 0; z < grid_.counts[2]; ++z) {
      for (std::uint32_t y = 0; y < grid_.counts[1]; ++y) {
        for (std::uint32_t x = 0; x < grid_.counts[0]; ++x) visit(Cell{x, y, z});
      }
    }
  }
  std::size_t indexOf(Cell c) const {
    return c[0] + std::size_t{grid_.counts[0]} * (c[1] + std::size_t{grid_.counts[1]} * c[2]);
  }
  double distanceAt(Cell c) const { return grid_.distances[grid_.cornerIndex(c[0], c[1], c[2])]; }
  bool isInside(Cell c) const { return distanceAt(c) < 0; }

  // In the middle of where the surface passes the cell's edges.
  void placePoint(Cell cell) {
    Vec3d sum;
    int count = 0;
    for (int axis = 0; axis < 3; ++axis) {
      for (std::uint32_t side = 0; side < 4; ++side) {
        Cell from = cell;
        from[(axis + 1) % 3] += side & 1;
        from[(axis + 2) % 3] += side >> 1;
        Cell to = from;
        ++to[axis];
        const double a = distanceAt(from), b = distanceAt(to);
        if ((a < 0) == (b < 0)) continue;
        std::array<double, 3> at{double(from[0]), double(from[1]), double(from[2])};
        at[axis] += a / (a - b);
        sum += Vec3d{at[0], at[1], at[2]};
        ++count;
      }
    }
    if (count == 0) return;
    pointOf_[indexOf(cell)] = static_cast<std::uint32_t>(mesh_.points.size());
    mesh_.points.push_back(grid_.origin + sum * (grid_.cell / count));
  }

  // About the edge along `axis` from the cell's first corner, among the four cells that share it.
  void placeFace(Cell cell, int axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (cell[u] == 0 || cell[v] == 0) return;
    Cell to = cell;
    ++to[axis];
    const bool begins = isInside(cell);
    if (begins == isInside(to)) return;
    std::array<std::uint32_t, 4> around{};
    for (int k = 0; k < 4; ++k) {  // counter-clockwise seen from the edge's end
      Cell neighbour = cell;
      neighbour[u] -= k == 0 || k == 3 ? 1 : 0;
      neighbour[v] -= k < 2 ? 1 : 0;
      around[k] = pointOf_[indexOf(neighbour)];
    }
    if (!begins) std::swap(around[1], around[3]);
    mesh_.triangles.push_back({around[0], around[1], around[2]});
    mesh_.triangles.push_back({around[0], around[2], around[3]});
  }

  const DistanceGrid& grid_;
  std::vector<std::uint32_t> pointOf_;  // of each cell
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh surfaceOf(const Body& body) {
  switch (body.shape) {
    case BodyShape::sphere:
      return roundSurface(body.radius, 0);
    case BodyShape::capsule:
      return roundSurface(body.radius, body.length);
    case BodyShape::box:
      return boxSurface(body.halfExtents);
    case BodyShape::grid:
      return SurfaceNets(*body.grid).make();
    case BodyShape::plane:
      break;
  }
  return {};
}

}  // namespace ringlet
