// TriangleMesh: the surface of a body as triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ringlet/base/bounds.h"
#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"

namespace ringlet {

/// Triangles of shared points, counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Vec3d> points;                            // [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices of points
};

/// Errors: no triangles, an index without a point, a point of a triangle that is not finite.
Status checkMesh(const TriangleMesh& mesh);

/// Of all points that a triangle has; the mesh has passed checkMesh.
Bounds boundsOf(const TriangleMesh& mesh);

/// How many edges do not have exactly two triangles that pass them in opposite directions: the rims of holes,
/// edges of three and more, neighbours of which one is inside out. Points at exactly the same place count as
/// one, since many programs split them along seams. The mesh has passed checkMesh.
std::size_t openEdgeCount(const TriangleMesh& mesh);

/// Whether the surface has an inside and an outside everywhere: no open edge.
inline bool isWatertight(const TriangleMesh& mesh) { return openEdgeCount(mesh) == 0; }

}  // namespace ringlet
