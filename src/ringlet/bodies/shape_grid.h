// Distance grids of shapes that a formula gives.
#pragma once

#include <functional>

#include "ringlet/base/bounds.h"
#include "ringlet/base/vec3.h"
#include "ringlet/scene/distance_grid.h"

namespace ringlet {

/// `distance` [m], negative inside, at every corner of cubic cells of edge `cell` [m] that cover `bounds`,
/// from its low corner on. The surface should lie within the bounds, with room.
DistanceGrid sampleDistance(const std::function<double(Vec3d)>& distance, const Bounds& bounds, double cell);

}  // namespace ringlet
