// Implements scene/outside_numbers.h.
#include "ringlet/scene/outside_numbers.h"

#include <fmt/format.h>

namespace ringlet {

Status checkEach(std::span<const Vec3f> vectors, const char* what, const NumberRange& range,
                 const char* unit) {
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    const Vec3f v = vectors[i];
    if (contains(range, Vec3d(v))) continue;
    return Error{fmt::format("the {} of particle {} is ({}, {}, {}); each number takes {} to {} {}", what, i,
                             v.x, v.y, v.z, range.low, range.high, unit)};
  }
  return {};
}

Status checkGoals(std::span<const Vec3f> places, std::span<const float> strengths, double dampingRatio,
                  std::span<const Vec3f> from) {
  for (const std::span<const Vec3f> some : {places, from}) {
    if (Status status = checkEach(some, "goal", kOutsidePlace, "m"); !status) return status;
  }
  for (std::size_t i = 0; i < strengths.size(); ++i) {
    if (kGoalStrength.contains(strengths[i])) continue;
    return Error{fmt::format("the goal of particle {} has a strength of {}; it takes {} to {}", i,
                             strengths[i], kGoalStrength.low, kGoalStrength.high)};
  }
  if (kGoalDamping.contains(dampingRatio)) return {};
  return Error{fmt::format("goals have a damping ratio of {}; it takes {} to {}", dampingRatio,
                           kGoalDamping.low, kGoalDamping.high)};
}

}  // namespace ringlet
