// Implements output/finite_points.h.
#include "ringlet/output/finite_points.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace ringlet {

// Exponents of all ones are infinities and NaN. Without a branch, so that compilers look at several at once.
bool areFinite(std::span<const Vec3f> points) {
  constexpr std::uint32_t kExponent = 0x7f800000;
  const auto isOpen = [](float x) -> std::uint32_t {
    return (std::bit_cast<std::uint32_t>(x) & kExponent) == kExponent ? 1 : 0;
  };
  std::uint32_t some = 0;
  for (const Vec3f& point : points) some |= isOpen(point.x) | isOpen(point.y) | isOpen(point.z);
  return some == 0;
}

std::size_t replaceNonfinite(const Groom& topology, std::span<Vec3f> points) {
  RINGLET_ASSERT(points.size() == topology.points.size(), "one point per particle of the groom");
  if (areFinite(points)) return 0;
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
