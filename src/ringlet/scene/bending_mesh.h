// BendingMesh: the surface of a body that bends, whose distance grid is made anew while it moves.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/scene/closed_mesh.h"

namespace ringlet {

/// What does not change: the surface, and the grid in the frame of what carries the body. The grid need not
/// hold the whole surface: hair meets the body where the grid is.
struct BendingMesh {
  ClosedMesh surface;                     // triangles counter-clockwise seen from outside
  std::vector<Vec3d> points;              // of the mesh it follows, before the first frame, in that frame [m]
  Vec3d origin;                           // of the grid's corner (0, 0, 0) [m]
  double cell = 0.01;                     // edge of a cell [m], above 0
  std::array<std::uint32_t, 3> counts{};  // cells along x, y, z, at least 1
  // No point comes further from the grid's middle along any axis [m]; one that does counts as there where
  // insides are told from outsides.
  double reach = 1;
  // Cloth: hair is kept off both of its sides, whether it is open or closed, and it has no grid: origin, cell
  // and counts then are the box in which it stays, and its triangles are in the order of orderedAsTree
  // (bodies/cloth_tree.h).
  bool isCloth = false;

  std::size_t cornerCount() const {
    return (counts[0] + std::size_t{1}) * (counts[1] + std::size_t{1}) * (counts[2] + std::size_t{1});
  }
  /// Steps of a cell to which points are rounded where columns of corners are counted through the surface: a
  /// power of two, at most 64, and as many as keep points within kMostSteps of the middle.
  double stepsPerCell() const {
    const double most = kMostSteps / std::max(reach / cell, 1.0);
    return std::clamp(std::exp2(std::floor(std::log2(most))), 1.0, 64.0);
  }
  static constexpr double kMostSteps = 8192;  // products of twice as many fit into 32 bits
};

}  // namespace ringlet
