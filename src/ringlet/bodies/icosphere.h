// A sphere of triangles of nearly one size.
#pragma once

#include "ringlet/bodies/triangle_mesh.h"

namespace ringlet {

/// The unit sphere about the origin: an icosahedron whose edges are cut into `frequency` parts, at least 1,
/// and whose points are then moved out onto the sphere. 20 frequency^2 triangles, watertight.
TriangleMesh makeIcosphere(int frequency);

}  // namespace ringlet
