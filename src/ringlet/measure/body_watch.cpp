// Implements measure/body_watch.h.
#include "ringlet/measure/body_watch.h"

#include <algorithm>

#include "ringlet/base/assert.h"
#include "ringlet/bodies/body_distance.h"

namespace ringlet {
namespace {

// The largest slope of a distance: sqrt(3) where it is interpolated in a grid, since corners of an edge
// differ by at most the edge's length; and 2 beyond the grid.
constexpr double kSteepest = 2;

// Hair that lies on a surface is on either side of it, because of rounding in positions and distance grids.
// Such a particle is not inside the body; but one that started there has not been outside either [m].
constexpr double kOnSurface = 1e-5;

// What was seen of a particle and a body in all calls of look.
enum Seen : std::uint8_t { kInside, kOutside, kOnIt };

// A ball that is outside of a body. Particles in it need no distance; the next ones of the strand may be.
struct Clearance {
  Vec3d middle{};
  double radius = 0;  // 0 or less: no ball [m]

  bool has(Vec3d place) const {
    const Vec3d arm = place - middle;
    return radius > 0 && dot(arm, arm) < radius * radius;
  }
};

}  // namespace

BodyWatch::BodyWatch(const Groom& groom, std::span<const Body> bodies, int rootCount)
    : firstPoint_(groom.firstPoint),
      bodies_(bodies.begin(), bodies.end()),
      rootCount_(static_cast<std::size_t>(rootCount)),
      seen_(groom.points.size() * bodies.size(), kInside) {}

void BodyWatch::look(std::span<const Vec3f> positions, const HeadPose& head,
                     std::span<const BodyPose> poses) {
  RINGLET_ASSERT(poses.size() == bodies_.size(), "every body has a pose");
  RINGLET_ASSERT(positions.size() * bodies_.size() == seen_.size(), "every particle has a position");
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (bodies_[b].bends()) continue;
    for (std::size_t s = 0; s + 1 < firstPoint_.size(); ++s) {
      Clearance clearance;
      for (std::size_t i = firstPoint_[s] + rootCount_; i < firstPoint_[s + 1]; ++i) {
        const Vec3d place(positions[i]);
        std::uint8_t& seen = seen_[b * positions.size() + i];
        if (clearance.has(place)) {
          seen = kOutside;
          continue;
        }
        const double distance = distanceTo(bodies_[b], poses[b], head.position + place);
        clearance = {place, distance / kSteepest};
        // Particles in the ball are not measured, so their distance may be this small.
        numbers_.nearest = std::min(numbers_.nearest, distance - std::max(0., clearance.radius));
        if (distance >= 0) seen = kOutside;
        if (seen == kInside && distance >= -kOnSurface) seen = kOnIt;
        if (seen != kOutside || !(-distance > numbers_.deepest)) continue;
        numbers_.deepest = -distance;
        numbers_.strand = static_cast<std::int64_t>(s);
        numbers_.particle = static_cast<std::int64_t>(i - firstPoint_[s]);
        numbers_.frame = looks_;
      }
    }
  }
  ++looks_;
}

BodyNumbers BodyWatch::numbers() const {
  BodyNumbers numbers = numbers_;
  const std::size_t count = bodies_.empty() ? 0 : seen_.size() / bodies_.size();
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (bodies_[b].bends()) continue;
    for (std::size_t s = 0; s + 1 < firstPoint_.size(); ++s) {
      for (std::size_t i = firstPoint_[s] + rootCount_; i < firstPoint_[s + 1]; ++i)
        numbers.inside += seen_[b * count + i] == kInside ? 1 : 0;
    }
  }
  return numbers;
}

}  // namespace ringlet
