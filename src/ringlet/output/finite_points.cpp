// Implements output/finite_points.h.
#include "ringlet/output/finite_points.h"

#include <cmath>

namespace ringlet {

std::size_t replaceNonfinite(const Groom& topology, std::span<Vec3f> points) {
  RINGLET_ASSERT(points.size() == topology.points.size(), "one point per particle of the groom");
  std::size_t moved = 0;
  for (std::size_t strand = 0; strand < topology.strandCount(); ++strand) {
    Vec3f last;
    for (std::size_t i = topology.firstPoint[strand]; i < topology.firstPoint[strand + 1]; ++i) {
      Vec3f& point = points[i];
      if (std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z)) {
        last = point;
      } else {
        point = last;
        ++moved;
      }
    }
  }
  return moved;
}

}  // namespace ringlet
