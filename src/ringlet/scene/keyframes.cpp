// Implements scene/keyframes.h.
#include "ringlet/scene/keyframes.h"

#include <algorithm>
#include <cmath>

namespace ringlet {

namespace {

// How long a turn has gone on at full speed, t seconds before the first key: all of the last tenth of a
// second, and ever less before.
double turnedSeconds(double t) {
  constexpr double kFull = 0.1, kEase = 0.2;  // [s]
  return t < kFull ? t : kFull + kEase * (1 - std::exp((kFull - t) / kEase));
}

// The rotation vector [rad] of a turn.
Vec3d rotationVector(Quatd turn) {
  if (turn.w < 0) turn = {-turn.x, -turn.y, -turn.z, -turn.w};
  const Vec3d axis{turn.x, turn.y, turn.z};
  const double sine = length(axis);
  return sine > 0 ? axis * (2 * std::atan2(sine, turn.w) / sine) : Vec3d{};
}

}  // namespace

HeadPose Keyframes::poseAt(double t) const {
  const HeadPose& first = poses.front();
  if (poses.size() == 1) return {first.position, first.rotation};
  if (t < 0) {
    const Vec3d velocity = (poses[1].position - first.position) / secondsPerKey;
    const Vec3d turning = rotationVector(poses[1].rotation * first.rotation.conjugate()) / secondsPerKey;
    return {first.position + velocity * t,
            normalized(fromRotationVector(turning * -turnedSeconds(-t)) * first.rotation)};
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
    const Quatd turn = poses[k + 1].rotation * poses[k].rotation.conjugate();
    const double speed = length(rotationVector(turn)) / secondsPerKey;
    if (speed > fastest.speed) fastest = {speed, k};
  }
  return fastest;
}

}  // namespace ringlet
