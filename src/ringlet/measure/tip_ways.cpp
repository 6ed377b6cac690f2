// Implements measure/tip_ways.h.
#include "ringlet/measure/tip_ways.h"

#include <fmt/format.h>

#include <cmath>

#include "ringlet/base/assert.h"

namespace ringlet {
namespace {

// The tip of strand s relative to its root [m], along world axes.
Vec3d tipFromRoot(const Groom& rest, std::span<const Vec3f> points, std::size_t s) {
  const Vec3d root(points[rest.firstPoint[s]]), tip(points[rest.firstPoint[s + 1] - 1]);
  return (tip - root) * rest.metresPerUnit;
}

}  // namespace

Result<TipWays> tipWays(const GroomRuler& ruler, const Groom& rest, std::span<const Vec3f> points,
                        std::span<const Vec3f> other) {
  RINGLET_ASSERT(points.size() == rest.points.size() && other.size() == rest.points.size(),
                 "one point per particle of the groom");
  const Quatd here = ruler.headRotationOf(points, rest.metresPerUnit).conjugate();
  const Quatd there = ruler.headRotationOf(other, rest.metresPerUnit).conjugate();
  TipWays ways;
  for (std::size_t s = 0; s < rest.strandCount(); ++s) {
    const Vec3d atRest = tipFromRoot(rest, rest.points, s);
    const Vec3d a = rotate(here, tipFromRoot(rest, points, s)),
                b = rotate(there, tipFromRoot(rest, other, s));
    if (!isFinite(a) || !isFinite(b))
      return Error{fmt::format("strand {}: its tip or root is not finite", s)};
    ways.way += length(a - atRest);
    ways.other += length(b - atRest);
    ways.apart += length(a - b);
  }
  const double share = 1 / static_cast<double>(rest.strandCount());
  return TipWays{ways.way * share, ways.other * share, ways.apart * share};
}

}  // namespace ringlet
