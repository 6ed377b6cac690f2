// ClosedMesh: a mesh without holes that moves with one that may have some: of a bust, say, which is open
// below.
//
//      .---.             .---.
//     (     )           (     )
//      `) (`             `) (`
//       | |  <- open      |_|  <- a cap: a fan of triangles about the mean of the rim, which moves with it
//
// Caps follow from the triangles alone. Where the triangles pass an edge in one direction more often than in
// the other, caps pass it as often the other way; such edges always make up whole rims, so every mesh can be
// closed and none leaks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/vec3.h"

namespace ringlet {

struct ClosedMesh {
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices of its own points; caps are the last
  std::vector<std::uint32_t> sources;                   // points of the mesh that its first points are
  std::vector<std::vector<std::uint32_t>> rims;  // of its own points, one for each cap; the caps' middles are
                                                 // its last points, in this order

  std::size_t pointCount() const { return sources.size() + rims.size(); }
  /// Its points where the mesh's are `points`. Cost: linear.
  std::vector<Vec3d> pointsOf(std::span<const Vec3d> points) const {
    std::vector<Vec3d> own;
    own.reserve(pointCount());
    for (const std::uint32_t source : sources) own.push_back(points[source]);
    for (const auto& rim : rims) {
      Vec3d sum{};
      for (const std::uint32_t point : rim) sum += own[point];
      own.push_back(sum / static_cast<double>(rim.size()));
    }
    return own;
  }
};

}  // namespace ringlet
