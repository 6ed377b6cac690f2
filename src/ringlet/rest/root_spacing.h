// Mean spacing of the roots of a groom, from which the default contact radius follows.
#pragma once

#include <span>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// Mean over points of the distance to the nearest other point; 0 for fewer than two points. The order of
/// points changes no bit. Cost: n log n.
double meanNearestDistance(std::span<const Vec3d> points);

}  // namespace ringlet
