// Implements groom/strands_of_points.h.
#include "ringlet/groom/strands_of_points.h"

#include <fmt/format.h>

namespace ringlet {

Status checkWholeStrands(std::size_t pointCount, std::uint32_t pointsPerStrand) {
  if (pointsPerStrand < 2)
    return Error{fmt::format("{} points a strand; a strand needs two", pointsPerStrand)};
  if (pointCount > 0 && pointCount % pointsPerStrand == 0) return {};
  return Error{fmt::format("has {} points, which are no whole number of strands of {} points each",
                           pointCount, pointsPerStrand)};
}

Result<LoadedGroom> strandsOfPoints(std::span<const Vec3f> points, std::uint32_t pointsPerStrand,
                                    const std::string& name) {
  if (Status whole = checkWholeStrands(points.size(), pointsPerStrand); !whole)
    return Error{fmt::format("{}: {}", name, whole.error().message)};
  LoadedGroom loaded;
  loaded.groom.points.assign(points.begin(), points.end());
  for (std::size_t end = pointsPerStrand; end <= points.size(); end += pointsPerStrand)
    loaded.groom.firstPoint.push_back(static_cast<std::uint32_t>(end));
  return loaded;
}

}  // namespace ringlet
