// meanOf: the mean of places, in double.
#pragma once

#include <algorithm>
#include <cstddef>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// Of a range of Vec3d or Vec3f, in its unit; {0, 0, 0} of none.
template <class Places>
Vec3d meanOf(const Places& places) {
  Vec3d sum{};
  for (const auto& place : places) sum += static_cast<Vec3d>(place);
  return sum / static_cast<double>(std::max<std::size_t>(places.size(), 1));
}

}  // namespace ringlet
