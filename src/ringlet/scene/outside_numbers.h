// What a program may hand over for particles: forces, goals, states. Beyond it float32 does not hold what the
// solver makes of them.
#pragma once

#include <span>

#include "ringlet/base/number_range.h"
#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"

namespace ringlet {

inline constexpr NumberRange kOutsidePlace{-1e6, 1e6};  // of a particle, along each axis [m]
inline constexpr NumberRange kOutsideSpeed{-1e6, 1e6};  // [m/s]
inline constexpr NumberRange kOutsideForce{-1e6, 1e6};  // on each kilogram [m/s^2]
inline constexpr NumberRange kGoalStrength{0, 1e7};
inline constexpr NumberRange kGoalDamping{0, 1000};  // ratio
inline constexpr NumberRange kPosePlace{-1e9, 1e9};  // of heads and bodies, as of a groom's points [m]

/// Fails with the first particle of which a component is out of the range, or no number. `what`: "force".
Status checkEach(std::span<const Vec3f> vectors, const char* what, const NumberRange& range,
                 const char* unit);
/// What Simulation::setGoals takes.
Status checkGoals(std::span<const Vec3f> places, std::span<const float> strengths, double dampingRatio,
                  std::span<const Vec3f> from);

inline bool contains(const NumberRange& range, Vec3d v) {
  return range.contains(v.x) && range.contains(v.y) && range.contains(v.z);
}

}  // namespace ringlet
