// Implements rest/strand_order.h.
#include "ringlet/rest/strand_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "ringlet/base/bounds.h"
#include "ringlet/base/mean.h"

namespace ringlet {
namespace {

// Bits of a cell index of the Hilbert curve per axis: cells are far smaller than the distances of strands,
// and three indices fit into 64 bits.
constexpr int kCurveBits = 16;

/// Place along the Hilbert curve of a cell: Skilling, "Programming the Hilbert curve", AIP Conference
/// Proceedings 707, 2004.
std::uint64_t placeOnCurve(std::array<std::uint32_t, 3> x) {
  // Undo the rotations of nested cubes, from the largest.
  for (std::uint32_t q = 1u << (kCurveBits - 1); q > 1; q >>= 1) {
    const std::uint32_t below = q - 1;
    for (std::uint32_t& axis : x) {
      if (axis & q) {
        x[0] ^= below;
      } else {
        const std::uint32_t exchanged = (x[0] ^ axis) & below;
        x[0] ^= exchanged;
        axis ^= exchanged;
      }
    }
  }
  // Gray code.
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t flips = 0;
  for (std::uint32_t q = 1u << (kCurveBits - 1); q > 1; q >>= 1) {
    if (x[2] & q) flips ^= q - 1;
  }
  for (std::uint32_t& axis : x) axis ^= flips;
  // Interleave.
  std::uint64_t place = 0;
  for (int bit = kCurveBits - 1; bit >= 0; --bit) {
    for (std::uint32_t axis : x) place = place << 1 | (axis >> bit & 1);
  }
  return place;
}

std::vector<std::uint64_t> placesOnCurve(const Groom& groom) {
  std::vector<Vec3d> means;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) means.push_back(meanOf(groom.strand(s)));
  Bounds box = Bounds::none();
  for (Vec3d m : means) box.add(m);
  const auto& [low, high] = box;
  const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  const double most = (1 << kCurveBits) - 1;
  const auto cell = [&](double above) {
    const double share = above / extent;  // points that are not finite are refused later, so any cell will do
    return share >= 0 && share <= 1 ? static_cast<std::uint32_t>(most * share) : 0u;
  };
  std::vector<std::uint64_t> places;
  for (Vec3d m : means)
    places.push_back(placeOnCurve({cell(m.x - low.x), cell(m.y - low.y), cell(m.z - low.z)}));
  return places;
}

}  // namespace

std::vector<std::uint32_t> orderAlongCurve(const Groom& groom) {
  const std::vector<std::uint64_t> places = placesOnCurve(groom);
  std::vector<std::uint32_t> order(groom.strandCount());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const std::size_t sizeA = groom.strand(a).size(), sizeB = groom.strand(b).size();
    return sizeA != sizeB ? sizeA < sizeB : places[a] < places[b];
  });
  return order;
}

}  // namespace ringlet
