// Implements groom/groom_check.h.
#include "ringlet/groom/groom_check.h"

#include <fmt/format.h>

#include <cmath>

#include "ringlet/base/assert.h"

namespace ringlet {

Status checkGroom(const Groom& topology, std::span<const Vec3f> points, const std::filesystem::path& path) {
  const auto& first = topology.firstPoint;
  RINGLET_ASSERT(!first.empty() && first.front() == 0 && first.back() == points.size(),
                 "a groom's firstPoint goes from 0 to its number of points");
  RINGLET_ASSERT(topology.points.size() == points.size(), "as many points as the groom has");
  if (topology.strandCount() == 0)
    return Error{fmt::format("{}: the groom has no strands to write", path.string())};

  for (std::size_t s = 0; s < topology.strandCount(); ++s) {
    RINGLET_ASSERT(first[s] <= first[s + 1] && first[s + 1] <= points.size(), "a groom's firstPoint ascends");
    const std::size_t count = first[s + 1] - first[s];
    if (count < 2) {
      return Error{fmt::format("{}: strand {} has {} particles; a strand needs 2 to be written",
                               path.string(), s, count)};
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3f p = points[first[s] + i];
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        return Error{
            fmt::format("{}: strand {}, particle {} is ({}, {}, {}); only finite positions can be written",
                        path.string(), s, i, p.x, p.y, p.z)};
      }
    }
  }
  return {};
}

}  // namespace ringlet
