// How close the roots of a groom stand: what a contact radius is taken from.
#pragma once

#include <span>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// Mean over points of the distance to the nearest other point; 0 for fewer than two. Points in one place are
/// 0 apart. Their order changes no bit. Cost: n log n.
double meanNearestDistance(std::span<const Vec3d> points);

}  // namespace ringlet
