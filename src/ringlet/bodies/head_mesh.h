// A stylised head for generated grooms, on which makeHead's hair grows.
#pragma once

#include "ringlet/bodies/triangle_mesh.h"
#include "ringlet/groom/generate.h"

namespace ringlet {

/// Scalp, face with nose and chin, and neck, in metres, about the middle of the scalp's sphere, the face
/// towards +Z; made for a scalp of 0.09 m, down to whose neck's end are 0.13 m, and scaled with it. Above the
/// hairline its points are on the sphere of head.scalpRadius, and its triangles, as chords, at most 0.2 %
/// inside it; below they are on the sphere or outside it. Of `head` only the scalp's radius and the
/// hairline's two elevations matter, which makeHead finds right. Some 4,000 triangles, watertight.
TriangleMesh makeHeadMesh(const HeadParameters& head = {});

}  // namespace ringlet
