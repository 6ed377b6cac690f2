// Points of hairs that keep their own shape at rest beside the guides they follow.
#pragma once

#include <span>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/follow/follow_hairs.h"
#include "ringlet/follow/rest_shape.h"

namespace ringlet {

/// Of a hair with these points at rest [m], at least two: each stands beside its guide where that is as long
/// from the root, times FollowHair::length over the whole of both, and is there but for rounding while the
/// guides have their rest shape. `guides`: the shapes of all. Cost: points.
std::vector<OwnPoint> ownPointsOf(const FollowHair& hair, std::span<const Vec3d> points,
                                  std::span<const RestShape> guides);

}  // namespace ringlet
