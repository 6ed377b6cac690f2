// Implements measure/body_watch.h.
#include "ringlet/measure/body_watch.h"

#include <algorithm>
#include <optional>

#include "ringlet/base/assert.h"
#include "ringlet/base/bounds.h"
#include "ringlet/bodies/body_distance.h"
#include "ringlet/bodies/near_triangles.h"
#include "ringlet/bodies/triangle_tree.h"

namespace ringlet {
namespace {

// The largest slope of a distance: sqrt(3) where it is interpolated in a grid, since corners of an edge
// differ by at most the edge's length; 2 beyond the grid; 1 to triangles.
constexpr double kSteepest = 2;

// Hair that lies on a surface is on either side of it, because of rounding in positions and distance grids.
// Such a particle is not inside the body; but one that started there has not been outside either [m].
constexpr double kOnSurface = 1e-5;

// The solver takes a smaller depth for outside, and corrects it in the next step: kOutside of
// shaders/equations/body_contact.glsl [m].
constexpr double kCorrected = 1e-4;

// What was seen of a particle and a body in all calls of look.
enum Seen : std::uint8_t { kInside, kOutside, kOnIt, kCaught };

// A ball that is outside of a body. Particles in it need no distance; the next ones of the strand may be.
struct Clearance {
  Vec3d middle{};
  double radius = 0;  // 0 or less: no ball [m]

  bool has(Vec3d place) const {
    const Vec3d arm = place - middle;
    return radius > 0 && dot(arm, arm) < radius * radius;
  }
};

// More triangles than this in a cell take longer than the way through the tree.
constexpr std::size_t kMostListed = 64;

// Of a body that bends, in the world; without points as it was at first.
TriangleMesh meshOf(const Body& body, const BodyPose& pose, std::span<const Vec3d> points) {
  std::vector<Vec3d> own(points.begin(), points.end());
  for (std::size_t i = 0; points.empty() && i < body.mesh->points.size(); ++i)
    own.push_back(pose.position + rotate(pose.rotation, body.mesh->points[i]));
  return {body.mesh->surface.pointsOf(own), body.mesh->surface.triangles};
}

class BentSurface {
 public:
  BentSurface(const Body& body, const BodyPose& pose, std::span<const Vec3d> points)
      : thickness_(body.thickness),
        mesh_(meshOf(body, pose, points)),
        bounds_(boundsOf(mesh_)),
        near_(mesh_, body.thickness),
        witnessOf_(near_.cellCount(), kNone) {}

  /// From its surface, thickness included [m]; negative inside, and exact there. Outside it may be less, but
  /// not below 0. Cheapest where each place is near the last.
  double distanceTo(Vec3d place) {
    const std::size_t cell = near_.cellAt(place);
    const bool isNear = cell != NearTriangles::kNoCell && near_.kindOf(cell) == NearTriangles::Cell::near;
    const bool isOutside =
        !isNear && (cell == NearTriangles::kNoCell || near_.kindOf(cell) == NearTriangles::Cell::outside);
    Seat seat{place, near_.reach(), false};
    if (cell == NearTriangles::kNoCell) seat.distance = std::max(seat.distance, bounds_.distanceTo(place));
    if (!isOutside) {
      if (isNear) seat.distance = nearDistance(place, cell);
      seat.isInside = isInside(seat, cell, isNear);
      // What is at least that far is measured only inside.
      if (seat.isInside && seat.distance >= near_.reach()) seat.distance = tree().nearest(place).distance;
    }
    last_ = seat;
    return (seat.isInside ? -seat.distance : seat.distance) - thickness_;
  }

 private:
  static constexpr std::uint32_t kNone = ~0u;
  // A place whose side is known; no surface is nearer than the distance.
  struct Seat {
    Vec3d place{};
    double distance = -1e300;  // at first there is none
    bool isInside = false;
  };

  double nearDistance(Vec3d place, std::size_t cell) {
    return near_.listedIn(cell) > kMostListed ? tree().nearest(place).distance
                                              : near_.distanceTo(place, cell);
  }

  // Two balls that hold no surface and meet are on one side of it; so are places with no triangle between.
  bool isInside(const Seat& seat, std::size_t cell, bool isNear) {
    const double way = length(seat.place - last_.place);
    if (way < seat.distance + last_.distance) return last_.isInside;
    if (!isNear || near_.listedIn(cell) > kMostListed) return tree().windingNumber(seat.place) > 0.5;
    if (last_.distance >= 0 && way < near_.reach() && near_.isFreeBetween(seat.place, last_.place, cell))
      return last_.isInside;
    return isInsideBeside(seat, cell);
  }

  // Asks the place that was seen first in the same cell.
  bool isInsideBeside(const Seat& seat, std::size_t cell) {
    std::uint32_t& witness = witnessOf_[cell];
    if (witness != kNone && near_.isFreeBetween(seat.place, witnesses_[witness].place, cell))
      return witnesses_[witness].isInside;
    const bool isInside = tree().windingNumber(seat.place) > 0.5;
    if (witness == kNone) {
      witness = static_cast<std::uint32_t>(witnesses_.size());
      witnesses_.push_back({seat.place, seat.distance, isInside});
    }
    return isInside;
  }

  const TriangleTree& tree() {
    if (!tree_) tree_.emplace(mesh_);
    return *tree_;
  }

  double thickness_;
  TriangleMesh mesh_;
  Bounds bounds_;
  NearTriangles near_;
  std::optional<TriangleTree> tree_;  // made when it is asked
  Seat last_;
  std::vector<std::uint32_t> witnessOf_;  // of each cell, in witnesses_
  std::vector<Seat> witnesses_;
};

}  // namespace

std::optional<double> gridCellOf(const Body& body) {
  if (body.isCloth()) return std::nullopt;
  if (body.bends()) return body.mesh->cell;
  return body.grid ? std::optional(body.grid->cell) : std::nullopt;
}

double keepsOutWithin(const Body& body) { return kCorrected + gridCellOf(body).value_or(0) / 2; }

BodyWatch::BodyWatch(const Groom& groom, std::span<const Body> bodies, int rootCount)
    : firstPoint_(groom.firstPoint),
      bodies_(bodies.begin(), bodies.end()),
      rootCount_(static_cast<std::size_t>(rootCount)),
      seen_(groom.points.size() * bodies.size(), kInside),
      numbers_(bodies.size()) {
  // Cloth has no inside.
  const std::size_t count = groom.points.size();
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies[b].isCloth()) std::fill_n(seen_.begin() + std::ptrdiff_t(b * count), count, kOutside);
}

// distanceAt: of a place relative to the head's origin [m].
template <class Distance>
void BodyWatch::lookAt(std::size_t body, std::span<const Vec3f> positions, const Distance& distanceAt) {
  BodyNumbers& numbers = numbers_[body];
  const double within = keepsOutWithin(bodies_[body]);
  for (std::size_t s = 0; s + 1 < firstPoint_.size(); ++s) {
    Clearance clearance;
    for (std::size_t i = firstPoint_[s] + rootCount_; i < firstPoint_[s + 1]; ++i) {
      const Vec3d place(positions[i]);
      std::uint8_t& seen = seen_[body * positions.size() + i];
      if (clearance.has(place)) {
        if (seen != kCaught) seen = kOutside;
        continue;
      }
      const double distance = distanceAt(place);
      clearance = {place, distance / kSteepest};
      // Particles in the ball are not measured, so their distance may be this small.
      numbers.nearest = std::min(numbers.nearest, distance - std::max(0., clearance.radius));
      if (distance >= 0 && seen != kCaught) seen = kOutside;
      if (seen == kInside && distance >= -kOnSurface) seen = kOnIt;
      if (seen == kOutside && -distance > within) seen = kCaught;
      if ((seen != kOutside && seen != kCaught) || !(-distance > numbers.deepest)) continue;
      numbers.deepest = -distance;
      numbers.strand = static_cast<std::int64_t>(s);
      numbers.particle = static_cast<std::int64_t>(i - firstPoint_[s]);
      numbers.frame = looks_;
    }
  }
}

void BodyWatch::look(std::span<const Vec3f> positions, const HeadPose& head, std::span<const BodyPose> poses,
                     BodyPoints points) {
  RINGLET_ASSERT(poses.size() == bodies_.size(), "every body has a pose");
  RINGLET_ASSERT(positions.size() * bodies_.size() == seen_.size(), "every particle has a position");
  RINGLET_ASSERT(!!checkBodyPoints(bendingPointCounts(bodies_), points),
                 "every mesh that bends has its points");
  std::size_t bending = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Body& body = bodies_[b];
    if (!body.bends()) {
      lookAt(b, positions, [&](Vec3d place) { return distanceTo(body, poses[b], head.position + place); });
      continue;
    }
    const std::span<const Vec3d> samples = points.empty() ? std::span<const Vec3d>() : points[bending++];
    const std::span<const Vec3d> last = points.empty() ? samples : samples.last(body.mesh->points.size());
    if (body.isCloth()) {
      const Bounds bounds = boundsOf(meshOf(body, poses[b], last));
      lookAt(b, positions, [&](Vec3d place) { return bounds.distanceTo(head.position + place); });
      continue;
    }
    BentSurface surface(body, poses[b], last);
    lookAt(b, positions, [&](Vec3d place) { return surface.distanceTo(head.position + place); });
  }
  ++looks_;
}

BodyNumbers BodyWatch::numbersOf(std::size_t body) const {
  BodyNumbers numbers = numbers_[body];
  const std::span<const std::uint8_t> seen = std::span(seen_).subspan(body * firstPoint_.back());
  for (std::size_t s = 0; s + 1 < firstPoint_.size(); ++s) {
    for (std::size_t i = firstPoint_[s] + rootCount_; i < firstPoint_[s + 1]; ++i) {
      numbers.inside += seen[i] == kInside ? 1 : 0;
      numbers.caught += seen[i] == kCaught ? 1 : 0;
    }
  }
  return numbers;
}

BodyNumbers BodyWatch::numbers() const {
  BodyNumbers all;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    BodyNumbers numbers = numbersOf(b);
    numbers.inside += all.inside;
    numbers.caught += all.caught;
    numbers.nearest = std::min(numbers.nearest, all.nearest);
    if (numbers.deepest <= all.deepest)
      numbers.deepest = all.deepest, numbers.strand = all.strand, numbers.particle = all.particle,
      numbers.frame = all.frame;
    all = numbers;
  }
  return all;
}

}  // namespace ringlet
