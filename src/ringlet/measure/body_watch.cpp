// Implements measure/body_watch.h.
#include "ringlet/measure/body_watch.h"

#include <algorithm>

#include "ringlet/base/assert.h"
#include "ringlet/bodies/body_distance.h"

namespace ringlet {
namespace {

// No distance changes faster along a way than by this factor: interpolated in a grid by sqrt(3), as those of
// neighbouring corners differ by an edge at most, and beyond it by 2.
constexpr double kSteepest = 2;

// Hair that lies on a surface is on either side of it, by the rounding of positions and of a distance grid.
// That is not in it, but what began there was never outside either [m].
constexpr double kOnSurface = 1e-5;

// Of a particle and a body, over all looks.
enum Seen : std::uint8_t { kInside, kOutside, kOnIt };

// A ball that is outside of a body: the next particles of the strand may be in it.
struct Clearance {
  Vec3d middle{};
  double radius = 0;  // not above 0: none [m]

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
        // Those within the clearance are not looked at.
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
    for (std::size_t s = 0; s + 1 < firstPoint_.size(); ++s) {
      for (std::size_t i = firstPoint_[s] + rootCount_; i < firstPoint_[s + 1]; ++i)
        numbers.inside += seen_[b * count + i] == kInside ? 1 : 0;
    }
  }
  return numbers;
}

}  // namespace ringlet
