// Implements motion/moving_body.h.
#include "ringlet/motion/moving_body.h"

#include <algorithm>

namespace ringlet {

std::vector<Vec3d> MovingBody::pointsAt(double t, const Motion& head) const {
  std::vector<Vec3d> points = mesh->pointsAt(mesh->firstSeconds() + std::max(t - start, 0.0));
  for (Vec3d& p : points) p += offset;
  if (t >= start) return points;
  const BodyPose then = early.poseAt(start, head.poseAt(start)), now = early.poseAt(t, head.poseAt(t));
  for (Vec3d& p : points)
    p = now.position + rotate(now.rotation * then.rotation.conjugate(), p - then.position);
  return points;
}

std::vector<Vec3d> MovingBody::pointsSeenAt(double t, const Body& of, const Motion& head) const {
  const BodyPose carrier = of.poseAt(t, head.poseAt(t));
  std::vector<Vec3d> points = pointsAt(t, head);
  for (Vec3d& p : points) p = seenFrom(carrier, p);
  return points;
}

}  // namespace ringlet
