// Implements groom/point_records.h.
#include "ringlet/groom/point_records.h"

#include <fmt/format.h>

#include <cmath>

#include "ringlet/base/little_endian.h"

namespace ringlet {

bool addStrandAt(std::span<const std::byte> bytes, const PointRecords& points, std::size_t strand,
                 Groom& groom, LeftOutStrands& leftOut) {
  std::size_t offset = points.offset;
  for (std::uint32_t i = 0; i < points.count; ++i, offset += points.stride) {
    const Vec3f p{readF32(bytes, offset), readF32(bytes, offset + 4), readF32(bytes, offset + 8)};
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      leftOut.add(
          fmt::format("at byte {}: found ({}, {}, {}) for strand {}, point {}; expected finite numbers",
                      offset, p.x, p.y, p.z, strand, i));
      groom.points.resize(groom.firstPoint.back());
      return false;
    }
    groom.points.push_back(p);
  }
  groom.firstPoint.push_back(static_cast<std::uint32_t>(groom.points.size()));
  return true;
}

}  // namespace ringlet
