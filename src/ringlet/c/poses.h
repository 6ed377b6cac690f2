// Poses of c/ringlet.h as the solver takes them.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "ringlet/base/vec3.h"
#include "ringlet/c/handles.h"
#include "ringlet/scene/outside_numbers.h"

namespace ringlet::c {

inline std::optional<Quatd> rotationOf(const double (&r)[4]) {
  if (r[0] == 0 && r[1] == 0 && r[2] == 0 && r[3] == 0) return Quatd{};
  const double length = std::hypot(std::hypot(r[0], r[1]), std::hypot(r[2], r[3]));
  if (!std::isfinite(length) || length == 0) return std::nullopt;
  return Quatd{r[0] / length, r[1] / length, r[2] / length, r[3] / length};
}

/// What is said of one that poseOf does not take.
inline constexpr const char* kWrongPose = "has a pose that is not finite, or more than 1e9 m away";

/// None where it is not finite or too far away.
template <class Pose>
std::optional<Pose> poseOf(const ringlet_pose& pose) {
  const auto rotation = rotationOf(pose.rotation);
  const Vec3d position{pose.position[0], pose.position[1], pose.position[2]};
  if (!rotation || !contains(kPosePlace, position)) return std::nullopt;
  Pose made;
  made.position = position, made.rotation = *rotation;
  return made;
}

inline Outcome notFinite(const char* what) {
  return Outcome::invalid(fmt::format("{} {}", what, kWrongPose));
}

}  // namespace ringlet::c
