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

// Every rotation is two quaternions: the one nearer to another.
Quatd nearer(Quatd q, Quatd to) {
  const bool isNear = q.x * to.x + q.y * to.y + q.z * to.z + q.w * to.w >= 0;
  return isNear ? q : Quatd{-q.x, -q.y, -q.z, -q.w};
}

// A pose as seven numbers, all of which take a cubic's way.
struct Numbers {
  Vec3d position;
  Quatd rotation;

  Numbers operator*(double f) const {
    return {position * f, {rotation.x * f, rotation.y * f, rotation.z * f, rotation.w * f}};
  }
  Numbers operator+(const Numbers& o) const {
    return {position + o.position,
            {rotation.x + o.rotation.x, rotation.y + o.rotation.y, rotation.z + o.rotation.z,
             rotation.w + o.rotation.w}};
  }
};

// Key k, its quaternion the one nearer to `like`.
Numbers numbersOf(const Keyframes& keys, std::size_t k, Quatd like) {
  return {keys.poses[k].position, nearer(keys.poses[k].rotation, like)};
}

// How fast the numbers of key k change as it is passed [1/s].
Numbers speedAt(const Keyframes& keys, std::size_t k, Quatd like) {
  const bool atStart = k == 0, atEnd = k + 1 == keys.poses.size();
  if ((atStart || atEnd) && keys.restsAtEnds) return {{}, {0, 0, 0, 0}};
  const bool isFirst = atStart || keys.isCut(k - 1), isLast = atEnd || keys.isCut(k);
  if (isFirst && isLast) return {{}, {0, 0, 0, 0}};
  const auto mean = [&](std::size_t from) {
    return (numbersOf(keys, from + 1, like) + numbersOf(keys, from, like) * -1) *
           (1 / (keys.timeOf(from + 1) - keys.timeOf(from)));
  };
  if (isFirst || isLast) return mean(isFirst ? k : k - 1);
  // Of the parabola through three keys: the mean speed of the shorter side counts more.
  const double before = keys.timeOf(k) - keys.timeOf(k - 1), after = keys.timeOf(k + 1) - keys.timeOf(k);
  return (mean(k - 1) * after + mean(k) * before) * (1 / (before + after));
}

// t seconds after key k, before the next.
HeadPose between(const Keyframes& keys, std::size_t k, double t) {
  const double seconds = keys.timeOf(k + 1) - keys.timeOf(k), s = t / seconds;
  const Numbers a = numbersOf(keys, k, keys.poses[k].rotation), b = numbersOf(keys, k + 1, a.rotation);
  if (keys.interpolation == Keyframes::Interpolation::linear)
    return {a.position + (b.position - a.position) * s, slerp(a.rotation, b.rotation, s)};
  // Hermite's.
  const double toB = s * s * (3 - 2 * s);
  const Numbers at = a * (1 - toB) + b * toB +
                     speedAt(keys, k, a.rotation) * (seconds * s * (1 - s) * (1 - s)) +
                     speedAt(keys, k + 1, b.rotation) * (seconds * s * s * (s - 1));
  return {at.position, normalized(at.rotation)};
}

// t seconds after key k, from which the head jumps to the next: on as it came.
HeadPose beforeCut(const Keyframes& keys, std::size_t k, double t) {
  HeadPose pose{keys.poses[k].position, keys.poses[k].rotation};
  if (k > 0 && !keys.isCut(k - 1)) {
    const double seconds = keys.timeOf(k) - keys.timeOf(k - 1);
    pose.position += (pose.position - keys.poses[k - 1].position) * (t / seconds);
  }
  return pose;
}

}  // namespace

HeadPose Keyframes::poseAt(double t) const {
  const HeadPose& first = poses.front();
  if (poses.size() == 1) return {first.position, first.rotation};
  if (t < timeOf(0)) {
    if (restsAtEnds) return {first.position, first.rotation};
    const double seconds = timeOf(1) - timeOf(0);
    const Vec3d velocity = (poses[1].position - first.position) / seconds;
    const Vec3d turning = rotationVector(poses[1].rotation * first.rotation.conjugate()) / seconds;
    return {first.position + velocity * (t - timeOf(0)),
            normalized(fromRotationVector(turning * -turnedSeconds(timeOf(0) - t)) * first.rotation)};
  }
  if (!times.empty()) {
    const auto next = std::upper_bound(times.begin(), times.end(), t);
    if (next == times.end()) return {poses.back().position, poses.back().rotation};
    const auto k = static_cast<std::size_t>(next - times.begin()) - 1;
    if (isCut(k)) return beforeCut(*this, k, t - times[k]);
    return between(*this, k, t - times[k]);
  }
  const double along = t / secondsPerKey;
  const auto last = static_cast<double>(poses.size() - 1);
  if (!(along < last)) return {poses.back().position, poses.back().rotation};
  const auto k = static_cast<std::size_t>(along);
  const double s = along - static_cast<double>(k);
  if (isCut(k)) return beforeCut(*this, k, s * secondsPerKey);
  if (restsAtEnds || interpolation == Interpolation::linear) return between(*this, k, s * secondsPerKey);
  const Vec3d p1 = poses[k].position, p2 = poses[k + 1].position;
  const Vec3d p0 = k > 0 && !isCut(k - 1) ? poses[k - 1].position : p1 * 2.0 - p2;
  const Vec3d p3 = k + 2 < poses.size() && !isCut(k + 1) ? poses[k + 2].position : p2 * 2.0 - p1;
  const Vec3d position =
      p1 +
      ((p2 - p0) + ((p0 * 2.0 - p1 * 5.0 + p2 * 4.0 - p3) + ((p1 - p2) * 3.0 + p3 - p0) * s) * s) * (0.5 * s);
  return {position, slerp(poses[k].rotation, poses[k + 1].rotation, s)};
}

Keyframes::Turn Keyframes::fastestTurn() const {
  Turn fastest;
  for (std::size_t k = 0; k + 1 < poses.size(); ++k) {
    const Quatd turn = poses[k + 1].rotation * poses[k].rotation.conjugate();
    const double speed = length(rotationVector(turn)) / (timeOf(k + 1) - timeOf(k));
    if (speed > fastest.speed) fastest = {speed, k};
  }
  return fastest;
}

}  // namespace ringlet
