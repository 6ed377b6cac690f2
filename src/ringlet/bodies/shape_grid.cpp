// Implements bodies/shape_grid.h.
#include "ringlet/bodies/shape_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "ringlet/base/assert.h"

namespace ringlet {

DistanceGrid sampleDistance(const std::function<double(Vec3d)>& distance, const Bounds& bounds, double cell) {
  const Vec3d size = bounds.high - bounds.low;
  RINGLET_ASSERT(cell > 0 && size.x >= 0 && size.y >= 0 && size.z >= 0,
                 "sampleDistance needs cells and bounds");
  DistanceGrid grid;
  grid.origin = bounds.low;
  grid.cell = cell;
  auto countAlong = [&](double side) {
    // Not one cell more for the last bit of a division.
    return static_cast<std::uint32_t>(std::max(1.0, std::ceil(side / cell - 1e-9)));
  };
  grid.counts = {countAlong(size.x), countAlong(size.y), countAlong(size.z)};
  grid.distances.reserve(grid.cornerIndex(grid.counts[0], grid.counts[1], grid.counts[2]) + 1);
  for (std::uint32_t z = 0; z <= grid.counts[2]; ++z) {
    for (std::uint32_t y = 0; y <= grid.counts[1]; ++y) {
      for (std::uint32_t x = 0; x <= grid.counts[0]; ++x) {
        const Vec3d place = grid.origin + Vec3d{double(x), double(y), double(z)} * cell;
        grid.distances.push_back(static_cast<float>(distance(place)));
      }
    }
  }
  return grid;
}

}  // namespace ringlet
