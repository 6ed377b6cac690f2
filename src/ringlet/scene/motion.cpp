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

// What a walk does beside its bob, per metre of it: some 2 cm to either side, 4 degrees of turning, 2 of
// nodding, where the bob is 2.5 cm.
constexpr double kSwayPerBob = 0.8;       // [m/m]
constexpr double kTurningPerBob = 2.8;    // [rad/m]
constexpr double kNoddingPerBob = 1.4;    // [rad/m]
constexpr double kNoddingAfterBob = 0.8;  // the head follows the body [rad]

// A jump's height over one period, as a share of its highest: a sum of two cosines, which stands at 0,
// crouches, leaps to 1, crouches as it lands and stands again, without a jerk.
//
//              .-.
//             :   :
//     0 -.   :     :   .-
//         `-'       `-'
double leap(double angle) { return 0.2 - 0.5 * std::cos(angle) + 0.3 * std::cos(2 * angle); }

constexpr Vec3d kSide{1, 0, 0};  // X, whichever of Y and Z is up

}  // namespace

double RootMotion::shareAt(double t) const {
  const double size = ease(t, easeSeconds) * ease(untilSeconds - t, easeSeconds);
  return frequency > 0 ? std::sin(2 * std::numbers::pi * frequency * t) * size : size;
}

HeadPose Motion::poseAt(double t) const {
  HeadPose pose{start, {}, roots.shareAt(t)};
  const double size = ease(t, easeSeconds) * ease(untilSeconds - t, easeSeconds);
  const double angle = 2 * std::numbers::pi * frequency * t;
  const double swing = std::sin(angle) * size;
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
    case MotionKind::walk: {
      // Two steps a stride: what is the same for either leg comes twice. The way forward is left out: at an
      // even pace hair does not feel it.
      const double bob = std::sin(2 * angle) * size, nodding = std::sin(2 * angle - kNoddingAfterBob) * size;
      pose.position += (axis * bob + kSide * (kSwayPerBob * swing)) * amplitude;
      pose.rotation = fromRotationVector(axis * (kTurningPerBob * amplitude * swing)) *
                      fromRotationVector(kSide * (kNoddingPerBob * amplitude * nodding));
      break;
    }
    case MotionKind::turn:
      pose.rotation = fromRotationVector(axis * (amplitude * ease(t, easeSeconds)));
      break;
    case MotionKind::jump:
      pose.position += axis * (amplitude * leap(angle) * size);
      break;
    case MotionKind::whip:
      pose.rotation = fromRotationVector(
          axis * (amplitude * (ease(t, easeSeconds) - ease(t - easeSeconds, easeSeconds))));
      break;
    case MotionKind::keyframes: {
      const HeadPose key = keyframes->poseAt(t);
      pose.position += key.position;
      pose.rotation = key.rotation;
      break;
    }
  }
  if (!(axes == Quatd{})) pose.rotation = normalized(pose.rotation * axes);
  return pose;
}

std::optional<Motion> motionByName(std::string_view name, Vec3d up) {
  if (name == "still") return Motion{};
  if (name == "shake")
    return Motion{.kind = MotionKind::shake, .axis = kSide, .amplitude = 0.1, .frequency = 2};
  if (name == "nod") return Motion{.kind = MotionKind::nod, .axis = kSide, .amplitude = 0.4, .frequency = 1};
  if (name == "spin") {
    return Motion{.kind = MotionKind::spin, .axis = up, .amplitude = std::numbers::pi, .easeSeconds = 0.5};
  }
  if (name == "glide") return Motion{.kind = MotionKind::glide, .axis = kSide, .amplitude = 1};
  if (name == "walk") return Motion{.kind = MotionKind::walk, .axis = up, .amplitude = 0.025, .frequency = 1};
  if (name == "turn") {
    return Motion{.kind = MotionKind::turn, .axis = kSide, .amplitude = std::numbers::pi, .easeSeconds = 1};
  }
  if (name == "jump")
    return Motion{.kind = MotionKind::jump, .axis = up, .amplitude = 0.2, .frequency = 1, .easeSeconds = 0.5};
  if (name == "whip") return Motion{.kind = MotionKind::whip, .axis = up, .amplitude = 1};
  return std::nullopt;
}

std::string motionName(MotionKind kind) {
  switch (kind) {
    case MotionKind::still:
      return "still";
    case MotionKind::shake:
      return "shake";
    case MotionKind::nod:
      return "nod";
    case MotionKind::spin:
      return "spin";
    case MotionKind::glide:
      return "glide";
    case MotionKind::walk:
      return "walk";
    case MotionKind::turn:
      return "turn";
    case MotionKind::jump:
      return "jump";
    case MotionKind::whip:
      return "whip";
    case MotionKind::keyframes:
      break;
  }
  return "keyframes";
}

bool isToAndFro(MotionKind kind) {
  return kind == MotionKind::shake || kind == MotionKind::nod || kind == MotionKind::walk ||
         kind == MotionKind::jump;
}

std::string motionNames() { return "still, shake, nod, spin, glide, walk, turn, jump, whip"; }

}  // namespace ringlet
