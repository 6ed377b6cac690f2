// RootSurface: the ball or plane that most roots are on.
#pragma once

#include <optional>
#include <span>

#include "ringlet/base/vec3.h"
#include "ringlet/groom/ball.h"

namespace ringlet {

/// A ball, or a plane through `middle` where the radius is 0.
struct RootSurface {
  Ball ball{};
  Vec3d middle{}, normal{};
  double side = 1;  // 1 where hair is outside, or where the normal points; -1 where it is the other way round
  double rms = 0;   // of the distances of the places it goes through

  double heightOf(Vec3d place) const {
    if (ball.radius > 0) return side * (length(place - ball.middle) - ball.radius);
    return side * dot(place - middle, normal);
  }
  /// Of length 1.
  Vec3d outwardAt(Vec3d place) const {
    return (ball.radius > 0 ? normalizedOr(place - ball.middle, Vec3d{0, 1, 0}) : normal) * side;
  }
};

/// Through seven of ten places, the nearest, whatever the others do; a ball where that is more even than a
/// plane, unless it is to be flat. None of places in a row. Cost: linear.
std::optional<RootSurface> surfaceThroughMost(std::span<const Vec3d> places, bool isFlat = false);

}  // namespace ringlet
