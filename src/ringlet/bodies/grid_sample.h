// What a distance grid says at a place between its corners, and beyond it; in double precision.
//
//   c the place within the grid that is nearest to place y, phi and n the interpolated distance and its unit
//   gradient there:
//
//     +---------+
//     |  ,-.    c - - y    the surface is within the grid, so that the angle at c is at least a right one and
//     | (   )   |          the distance at y at least sqrt(|y - c|^2 + phi_c^2)
//     |  `-'    |
//     +---------+
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "ringlet/base/vec3.h"
#include "ringlet/scene/distance_grid.h"

namespace ringlet {

/// How far a place is from the surface, and which way out is.
struct GridSample {
  double distance = 0;  // [m], negative inside
  Vec3d direction{};    // a unit vector; +Y where the grid has no gradient
};

/// At a place in the body's frame. Within the grid the trilinear interpolation of a cell's 8 corners and the
/// gradient of that; outside a distance that is no more than the true one, as far as interpolation goes.
inline GridSample sampleGrid(const DistanceGrid& grid, Vec3d place) {
  constexpr Vec3d kUp{0, 1, 0};
  // Place to cell: which, and how far across it, both within the grid.
  std::array<std::uint32_t, 3> cell{};
  std::array<double, 3> across{};
  const Vec3d scaled = (place - grid.origin) / grid.cell;
  const std::array<double, 3> at{scaled.x, scaled.y, scaled.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double inside = std::clamp(at[axis], 0.0, double(grid.counts[axis]));
    cell[axis] = std::min(static_cast<std::uint32_t>(inside), grid.counts[axis] - 1);
    across[axis] = inside - cell[axis];
  }

  // Along x first, then y, then z; each stage with the slopes of those before.
  auto corner = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return double{grid.distances[grid.cornerIndex(cell[0] + x, cell[1] + y, cell[2] + z)]};
  };
  auto mixed = [](double low, double high, double t) { return low + (high - low) * t; };
  double alongX[2][2], slopeX[2][2];
  for (std::uint32_t z = 0; z < 2; ++z) {
    for (std::uint32_t y = 0; y < 2; ++y) {
      slopeX[z][y] = corner(1, y, z) - corner(0, y, z);
      alongX[z][y] = corner(0, y, z) + slopeX[z][y] * across[0];
    }
  }
  const double low = mixed(alongX[0][0], alongX[0][1], across[1]);
  const double high = mixed(alongX[1][0], alongX[1][1], across[1]);
  const Vec3d gradient{mixed(mixed(slopeX[0][0], slopeX[0][1], across[1]),
                             mixed(slopeX[1][0], slopeX[1][1], across[1]), across[2]),
                       mixed(alongX[0][1] - alongX[0][0], alongX[1][1] - alongX[1][0], across[2]),
                       high - low};
  GridSample sample{mixed(low, high, across[2]), normalizedOr(gradient, kUp)};

  const Vec3d clamped = Vec3d{cell[0] + across[0], cell[1] + across[1], cell[2] + across[2]};
  const Vec3d beyond = (scaled - clamped) * grid.cell;
  if (beyond == Vec3d{}) return sample;
  const double left = std::max(sample.distance, 0.0);
  return {std::sqrt(dot(beyond, beyond) + left * left), normalizedOr(beyond + sample.direction * left, kUp)};
}

}  // namespace ringlet
