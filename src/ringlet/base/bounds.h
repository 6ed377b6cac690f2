// Bounds: a box parallel to the axes, from corner to corner.
#pragma once

#include <algorithm>
#include <limits>
#include <span>

#include "ringlet/base/vec3.h"

namespace ringlet {

struct Bounds {
  Vec3d low, high;

  /// About nothing yet: the first point that is added is both corners.
  static constexpr Bounds none() {
    constexpr double most = std::numeric_limits<double>::infinity();
    return {{most, most, most}, {-most, -most, -most}};
  }
  void add(Vec3d p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  bool contains(Vec3d p) const {
    return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y && low.z <= p.z && p.z <= high.z;
  }
  /// 0 inside.
  double distanceTo(Vec3d p) const {
    return length(Vec3d{std::max({low.x - p.x, 0., p.x - high.x}), std::max({low.y - p.y, 0., p.y - high.y}),
                        std::max({low.z - p.z, 0., p.z - high.z})});
  }
  /// Whether it has a size along each axis.
  bool hasRoom() const { return low.x < high.x && low.y < high.y && low.z < high.z; }
  Vec3d middle() const { return (low + high) / 2.0; }
  double diagonal() const { return length(high - low); }

  bool operator==(const Bounds&) const = default;
};

/// About all of the points; none() without any.
inline Bounds boundsOf(std::span<const Vec3f> points) {
  Bounds bounds = Bounds::none();
  for (const Vec3f& point : points) bounds.add(static_cast<Vec3d>(point));
  return bounds;
}

}  // namespace ringlet
