// Implements scene/keyframes.h.
#include "ringlet/scene/keyframes.h"

#include <algorithm>
#include <cmath>

namespace ringlet {

HeadPose Keyframes::poseAt(double t) const {
  const HeadPose& first = poses.front();
  if (t < 0) {
    const HeadPose ahead = poseAt(-t);
    return {first.position * 2.0 - ahead.position,
            normalized(first.rotation * ahead.rotation.conjugate() * first.rotation)};
  }
  const double along = t / secondsPerKey;
  const auto last = static_cast<double>(poses.size() - 1);
  if (!(along < last)) return {poses.back().position, poses.back().rotation};
  const auto k = static_cast<std::size_t>(along);
  const double s = along - static_cast<double>(k);
  const Vec3d p1 = poses[k].position, p2 = poses[k + 1].position;
  const Vec3d p0 = k > 0 ? poses[k - 1].position : p1 * 2.0 - p2;
  const Vec3d p3 = k + 2 < poses.size() ? poses[k + 2].position : p2 * 2.0 - p1;
  const Vec3d position =
      p1 +
      ((p2 - p0) + ((p0 * 2.0 - p1 * 5.0 + p2 * 4.0 - p3) + ((p1 - p2) * 3.0 + p3 - p0) * s) * s) * (0.5 * s);
  return {position, slerp(poses[k].rotation, poses[k + 1].rotation, s)};
}

Keyframes::Turn Keyframes::fastestTurn() const {
  Turn fastest;
  for (std::size_t k = 0; k + 1 < poses.size(); ++k) {
    const Quatd turn = poses[k].rotation.conjugate() * poses[k + 1].rotation;
    const double sine = std::sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
    const double speed = 2 * std::atan2(sine, std::abs(turn.w)) / secondsPerKey;
    if (speed > fastest.speed) fastest = {speed, k};
  }
  return fastest;
}

}  // namespace ringlet
