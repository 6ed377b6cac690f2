// DistanceGrid: how far every place near a body is from its surface, sampled on a regular grid of points.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// Signed distances at the corners of counts[0] x counts[1] x counts[2] cubic cells, in the body's own frame;
/// negative inside. The surface and some room about it lie within the grid.
struct DistanceGrid {
  Vec3d origin;                           // of corner (0, 0, 0) [m]
  double cell = 0.01;                     // edge of a cell [m], above 0
  std::array<std::uint32_t, 3> counts{};  // cells along x, y, z, at least 1
  std::vector<float> distances{};  // (counts[0] + 1)(counts[1] + 1)(counts[2] + 1) corners, x fastest [m]

  std::size_t cellCount() const { return std::size_t{counts[0]} * counts[1] * counts[2]; }
  std::size_t cornerIndex(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return x + (counts[0] + std::size_t{1}) * (y + (counts[1] + std::size_t{1}) * z);
  }
};

}  // namespace ringlet
