// lengthAlong: how long a strand is.
#pragma once

#include <cstddef>
#include <span>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// Sum of its edges, in its unit.
inline double lengthAlong(std::span<const Vec3f> strand) {
  double whole = 0;
  for (std::size_t i = 1; i < strand.size(); ++i) whole += length(Vec3d(strand[i]) - Vec3d(strand[i - 1]));
  return whole;
}

}  // namespace ringlet
