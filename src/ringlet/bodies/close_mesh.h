// Closes the holes of a mesh.
#pragma once

#include "ringlet/bodies/triangle_mesh.h"
#include "ringlet/scene/closed_mesh.h"

namespace ringlet {

/// The mesh has passed checkMesh. Points of open edges at exactly the same place become one, since many
/// programs split them along seams; other points stay by themselves, as those of lips that touch in this
/// pose. Cost: n log n.
ClosedMesh closed(const TriangleMesh& mesh);

}  // namespace ringlet
