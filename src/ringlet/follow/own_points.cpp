// Implements follow/own_points.h: reference/equations/follow.h at rest, where the head has not turned.
#include "ringlet/follow/own_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ringlet {
namespace {

// Of a guide beside a point of a hair.
struct Place {
  Vec3d core, curl;
  Quatd frame;
};

Vec3d mixed(Vec3d a, Vec3d b, double share) { return a * (1 - share) + b * share; }

Quatd mixed(Quatd a, Quatd b, double share) {
  const double with = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w < 0 ? -share : share;
  return normalized(Quatd{a.x * (1 - share) + b.x * with, a.y * (1 - share) + b.y * with,
                          a.z * (1 - share) + b.z * with, a.w * (1 - share) + b.w * with});
}

Place placeOn(const RestShape& guide, double along) {
  const std::size_t k = std::min(static_cast<std::size_t>(along), guide.core.size() - 2);
  const double between = along - static_cast<double>(k);
  const Vec3d curl = mixed(guide.curl[k], guide.curl[k + 1], between);
  const double size = (1 - between) * length(guide.curl[k]) + between * length(guide.curl[k + 1]);
  return {mixed(guide.core[k], guide.core[k + 1], between), normalizedOr(curl, Vec3d{}) * size,
          mixed(quaternionOf(guide.frames[k]), quaternionOf(guide.frames[k + 1]), between)};
}

double risesOver(double end, double share) {
  const double x = std::clamp(share / end, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

// Where the guides alone have a point of a hair at rest.
struct AtRest {
  const FollowHair& hair;
  double share, r, spread;

  AtRest(const FollowHair& of, double at)
      : hair(of),
        share(at),
        r(risesOver(0.2, at)),
        spread(1 + (static_cast<double>(of.spread) - 1) * risesOver(0.4, at)) {}

  Vec3d offset(const Place& place, Vec3d fromRoot, Vec3f alongFrame) const {
    return spread * ((1 - r) * fromRoot + r * rotate(place.frame, Vec3d(alongFrame)));
  }
  Vec3d followed(const Place& place, Vec3d fromRoot) const {
    const double angle = r * static_cast<double>(hair.phase);
    const double scale = 1 + (static_cast<double>(hair.radius) - 1) * r;
    const Vec3d z = place.curl;
    const Vec3d curl{std::cos(angle) * z.x - std::sin(angle) * z.y,
                     std::sin(angle) * z.x + std::cos(angle) * z.y, z.z};
    return place.core + rotate(place.frame, curl * scale) + offset(place, fromRoot, hair.offset);
  }
  Vec3d blended(const Place& place, Vec3d fromRoot, Vec3f alongFrame) const {
    return place.core + (1 - r) * rotate(place.frame, place.curl) + offset(place, fromRoot, alongFrame);
  }
};

// Where a guide is so far from its root [particles].
double alongAt(const RestShape& guide, double arc) {
  const auto after = std::ranges::upper_bound(guide.arcs, arc);
  if (after == guide.arcs.end()) return static_cast<double>(guide.arcs.size() - 1);
  const auto k = static_cast<std::size_t>(after - guide.arcs.begin()) - 1;
  return static_cast<double>(k) + (arc - guide.arcs[k]) / (guide.arcs[k + 1] - guide.arcs[k]);
}

}  // namespace

std::vector<OwnPoint> ownPointsOf(const FollowHair& hair, std::span<const Vec3d> points,
                                  std::span<const RestShape> guides) {
  const RestShape& guide = guides[hair.guide];
  const std::vector<double> arcs = arcPositions(points);
  const auto last = static_cast<double>(guide.core.size() - 1);
  const auto shareOfGuide = static_cast<double>(hair.length);
  const Vec3d fromRoot = outOfFrame(guide.frames.front(), Vec3d(hair.offset));
  const Vec3d root = guide.points.front() + fromRoot;
  std::vector<OwnPoint> own(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    own[i].along =
        static_cast<float>(alongAt(guide, arcs[i] / arcs.back() * shareOfGuide * guide.arcs.back()));
    const auto along = static_cast<double>(own[i].along);
    const AtRest rest(hair, std::min(along / (shareOfGuide * last), 1.0));
    const Place place = placeOn(guide, along);
    Vec3d x = rest.followed(place, fromRoot);
    for (const FollowHair::Other& other : hair.others) {
      if (!(other.share > 0)) continue;
      const RestShape& its = guides[other.guide];
      const Place there = placeOn(its, along / last * static_cast<double>(its.core.size() - 1));
      x += static_cast<double>(other.share) * (rest.blended(there, root - its.points.front(), other.offset) -
                                               rest.blended(place, fromRoot, hair.offset));
    }
    own[i].shift = Vec3f(rotate(place.frame.conjugate(), points[i] - x));
  }
  return own;
}

}  // namespace ringlet
