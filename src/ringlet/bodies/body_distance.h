// How deep places are in a body, for measures: in double precision, on the host.
#pragma once

#include "ringlet/base/vec3.h"
#include "ringlet/scene/body.h"

namespace ringlet {

/// From its surface, thickness included, of a place in the body's own frame [m]; negative inside. Of a
/// distance grid as sampleGrid says. Cost: constant.
double distanceTo(const Body& body, Vec3d place);

/// The same of a place in the world, with the body at `pose`.
double distanceTo(const Body& body, const BodyPose& pose, Vec3d place);

}  // namespace ringlet
