// Implements bodies/body_distance.h.
#include "ringlet/bodies/body_distance.h"

#include <algorithm>
#include <cmath>

#include "ringlet/bodies/grid_sample.h"

namespace ringlet {
namespace {

double distanceToBox(Vec3d half, Vec3d y) {
  const Vec3d beyond{std::abs(y.x) - half.x, std::abs(y.y) - half.y, std::abs(y.z) - half.z};
  const Vec3d outside{std::max(beyond.x, 0.0), std::max(beyond.y, 0.0), std::max(beyond.z, 0.0)};
  return length(outside) + std::min(std::max({beyond.x, beyond.y, beyond.z}), 0.0);
}

double distanceToShape(const Body& body, Vec3d y) {
  switch (body.shape) {
    case BodyShape::sphere:
      return length(y) - body.radius;
    case BodyShape::capsule:
      return length(y - Vec3d{0, std::clamp(y.y, -body.length / 2, body.length / 2), 0}) - body.radius;
    case BodyShape::plane:
      return y.y;
    case BodyShape::box:
      return distanceToBox(body.halfExtents, y);
    case BodyShape::grid:
      return sampleGrid(*body.grid, y).distance;
  }
  return 0;
}

}  // namespace

double distanceTo(const Body& body, Vec3d place) { return distanceToShape(body, place) - body.thickness; }

double distanceTo(const Body& body, const BodyPose& pose, Vec3d place) {
  return distanceTo(body, rotate(pose.rotation.conjugate(), place - pose.position));
}

}  // namespace ringlet
