// Implements measure/body_watch.h.
#include "ringlet/measure/body_watch.h"

#include "ringlet/base/assert.h"
#include "ringlet/bodies/body_distance.h"

namespace ringlet {
namespace {

// No distance changes faster along a way than by this factor: interpolated in a grid by sqrt(3), as those of
// neighbouring corners differ by an edge at most, and beyond it by 2.
constexpr double kSteepest = 2;

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
      wasOutside_(groom.points.size() * bodies.size(), 0) {}

void BodyWatch::look(std::span<const Vec3f> positions, const HeadPose& head,
                     std::span<const BodyPose> poses) {
  RINGLET_ASSERT(poses.size() == bodies_.size(), "every body has a pose");
  RINGLET_ASSERT(positions.size() * bodies_.size() == wasOutside_.size(), "every particle has a position");
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    for (std::size_t s = 0; s + 1 < firstPoint_.size(); ++s) {
      Clearance clearance;
      for (std::size_t i = firstPoint_[s] + rootCount_; i < firstPoint_[s + 1]; ++i) {
        const Vec3d place(positions[i]);
        std::uint8_t& wasOutside = wasOutside_[b * positions.size() + i];
        if (clearance.has(place)) {
          wasOutside = 1;
          continue;
        }
        const double distance = distanceTo(bodies_[b], poses[b], head.position + place);
        clearance = {place, distance / kSteepest};
        if (distance >= 0) wasOutside = 1;
        if (!wasOutside || !(-distance > numbers_.deepest)) continue;
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
  const std::size_t count = bodies_.empty() ? 0 : wasOutside_.size() / bodies_.size();
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    for (std::size_t s = 0; s + 1 < firstPoint_.size(); ++s) {
      for (std::size_t i = firstPoint_[s] + rootCount_; i < firstPoint_[s + 1]; ++i)
        numbers.inside += wasOutside_[b * count + i] ? 0 : 1;
    }
  }
  return numbers;
}

}  // namespace ringlet
