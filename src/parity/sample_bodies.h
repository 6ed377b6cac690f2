// Bodies that tests share.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "ringlet/scene/body.h"

namespace ringlet::parity {

/// A sphere about a place of its own axes as a distance grid, 1.5 radii to either side.
inline Body gridBall(double radius, double cell, Vec3d about = {}) {
  const auto count = static_cast<std::uint32_t>(std::lround(3 * radius / cell));
  DistanceGrid grid{
      .origin = about + Vec3d{-1.5, -1.5, -1.5} * radius, .cell = cell, .counts = {count, count, count}};
  for (std::uint32_t z = 0; z <= count; ++z) {
    for (std::uint32_t y = 0; y <= count; ++y) {
      for (std::uint32_t x = 0; x <= count; ++x) {
        const Vec3d place = grid.origin + Vec3d{double(x), double(y), double(z)} * cell;
        grid.distances.push_back(static_cast<float>(length(place - about) - radius));
      }
    }
  }
  return {.name = "grid",
          .shape = BodyShape::grid,
          .grid = std::make_shared<const DistanceGrid>(std::move(grid))};
}

/// One of each shape, some 20 cm across.
inline std::vector<Body> sampleBodies() {
  return {{.name = "sphere", .shape = BodyShape::sphere, .radius = 0.1},
          {.name = "capsule", .shape = BodyShape::capsule, .radius = 0.05, .length = 0.2},
          {.name = "plane", .shape = BodyShape::plane, .thickness = 0.01},
          {.name = "box", .shape = BodyShape::box, .halfExtents = {0.08, 0.1, 0.06}, .thickness = 0.01},
          gridBall(0.1, 0.005)};
}

}  // namespace ringlet::parity
