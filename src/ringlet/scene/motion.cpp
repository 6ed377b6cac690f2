// Implements scene/motion.h.
#include "ringlet/scene/motion.h"

#include <algorithm>
#include <numbers>

namespace ringlet {
namespace {

// 0 before t = 0, 1 after `seconds`, with continuous velocity and acceleration between (6 s^5 - 15 s^4 + 10
// s^3).
double ease(double t, double seconds) {
  if (t <= 0) return 0;
  if (t >= seconds) return 1;
  double s = t / seconds;
  return s * s * s * (10 + s * (6 * s - 15));
}

// The integral of ease from 0 to t: the angle turned by a spin that eases in.
double easeIntegral(double t, double seconds) {
  if (t <= 0) return 0;
  double s = std::min(t / seconds, 1.0);
  double within = seconds * s * s * s * s * (2.5 + s * (s - 3));
  return within + std::max(0.0, t - seconds);
}

}  // namespace

HeadPose Motion::poseAt(double t) const {
  HeadPose pose{start, {}};
  double swing = std::sin(2 * std::numbers::pi * frequency * t) * ease(t, easeSeconds);
  switch (kind) {
    case MotionKind::still:
      break;
    case MotionKind::shake:
      pose.position += axis * (amplitude * swing);
      break;
    case MotionKind::nod:
      pose.rotation = fromRotationVector(axis * (amplitude * swing));
      break;
    case MotionKind::spin:
      pose.rotation = fromRotationVector(axis * (amplitude * easeIntegral(t, easeSeconds)));
      break;
    case MotionKind::glide:
      pose.position += axis * (amplitude * t);
      break;
  }
  return pose;
}

std::optional<Motion> motionByName(std::string_view name, Vec3d up) {
  // The side: X, whichever of Y and Z is up.
  const Vec3d side{1, 0, 0};
  if (name == "still") return Motion{};
  if (name == "shake")
    return Motion{.kind = MotionKind::shake, .axis = side, .amplitude = 0.1, .frequency = 2};
  if (name == "nod") return Motion{.kind = MotionKind::nod, .axis = side, .amplitude = 0.4, .frequency = 1};
  if (name == "spin") {
    return Motion{.kind = MotionKind::spin, .axis = up, .amplitude = std::numbers::pi, .easeSeconds = 0.5};
  }
  if (name == "glide") return Motion{.kind = MotionKind::glide, .axis = side, .amplitude = 1};
  return std::nullopt;
}

std::string motionNames() { return "still, shake, nod, spin, glide"; }

}  // namespace ringlet
