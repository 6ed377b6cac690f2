// A stylised bust: head, neck, shoulders and upper chest.
#pragma once

#include "ringlet/bodies/triangle_mesh.h"

namespace ringlet {

/// In metres, about the middle of the head, Y up and the face towards +Z: 0.47 m high, 0.41 m wide.
/// Watertight, with a rounded underside; 4,512 triangles of about 1 to 2 cm.
TriangleMesh makeBustMesh();

/// On a bust of that mesh without a face [m]: `ring` of those about the vertical, from 0 at the crown to 24
/// beneath, and the angle from its front [rad].
Vec3d placeOnBust(double ring, double angle);

}  // namespace ringlet
