// NearTriangles: cells about the triangles of a closed mesh, to find at once those that are near a place, and
// places that are outside beyond doubt. Made anew where the mesh bends: linear in triangles and cells.
//
//     o o o o o o     o  outside: no triangle is near, and a way through such cells leads out of the box
//     o x x x x o     x  a triangle is nearer than `reach` to some place of the cell: it lists them
//     o x . . x o     .  neither: inside, or in a hollow
//     o x x x x o
//     o o o o o o
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/bodies/triangle_mesh.h"

namespace ringlet {

class NearTriangles {
 public:
  enum class Cell : std::uint8_t { outside, enclosed, near };
  static constexpr std::size_t kNoCell = ~std::size_t{0};

  /// Of a mesh without holes that has passed checkMesh. Places nearer than `leastReach` to a triangle are in
  /// cells that list it [m].
  NearTriangles(const TriangleMesh& mesh, double leastReach);

  /// Triangles that are not listed in the place's cell are at least this far from it [m].
  double reach() const { return reach_; }
  std::size_t cellCount() const { return cells_.size(); }
  /// The cell the place is in; kNoCell beyond the box, where all is outside.
  std::size_t cellAt(Vec3d place) const;
  Cell kindOf(std::size_t cell) const { return cells_[cell]; }
  std::size_t listedIn(std::size_t cell) const { return first_[cell + 1] - first_[cell]; }

  /// From the nearest triangle, exact where that is less than reach(); else reach() [m]. The place is in the
  /// cell.
  double distanceTo(Vec3d place, std::size_t cell) const;
  /// Whether no triangle is between two places of which one is in the cell, and the other, too, or within
  /// reach() of it. In doubt false.
  bool isFreeBetween(Vec3d place, Vec3d other, std::size_t cell) const;

 private:
  struct Triangle {
    std::array<Vec3d, 3> corners;
    Vec3d normal;  // of length 1; 0 of a needle, whose plane rounding turns
  };
  struct Range {
    std::array<int, 3> first, last;
  };

  void chooseCells(const TriangleMesh& mesh, double leastReach);
  template <class Visit>
  void forCellsNear(const Triangle& triangle, const Visit& visit) const;
  Range rangeOf(const Triangle& triangle) const;
  void list();
  void findOutside();

  std::vector<Triangle> triangles_;
  Vec3d low_{};
  double edge_ = 1, reach_ = 1, listingReach_ = 1;  // [m]
  std::array<int, 3> counts_{};
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> first_, listed_;  // of each cell, the first of its triangles in listed_
};

}  // namespace ringlet
