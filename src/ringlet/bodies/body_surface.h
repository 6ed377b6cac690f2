// A body's surface as triangles, to be looked at.
#pragma once

#include "ringlet/bodies/triangle_mesh.h"
#include "ringlet/scene/body.h"

namespace ringlet {

/// In the body's own frame [m], thickness left aside: of a distance grid where it is 0 (surface nets, Gibson
/// 1998: a point in each cell that the surface passes). Points of one smooth piece are shared. Empty for a
/// plane, which has no end. Cost: a look at each cell.
TriangleMesh surfaceOf(const Body& body);

}  // namespace ringlet
