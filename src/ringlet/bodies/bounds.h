// Bounds: a box parallel to the axes, from corner to corner.
#pragma once

#include "ringlet/base/vec3.h"

namespace ringlet {

struct Bounds {
  Vec3d low, high;  // [m]

  bool operator==(const Bounds&) const = default;
};

}  // namespace ringlet
