// Triangles and points of meshes that bend.
#ifndef RINGLET_MESH_POINTS
#define RINGLET_MESH_POINTS

#include "layout/mesh_fields.h"
#include "shared/texels.glsl"

layout(set = 0, binding = kBindMeshTriangles) readonly buffer Triangles { uvec4 triangles[]; };
layout(set = 0, binding = kBindMeshPoints) readonly buffer Points { vec4 points[]; };
layout(set = 0, binding = kMeshTexels + kBindMeshTriangles) uniform usamplerBuffer triangleTexels;
layout(set = 0, binding = kMeshTexels + kBindMeshPoints) uniform usamplerBuffer pointTexels;

uvec3 cornersOf(MeshRest mesh, uint triangle) {
  uint at = mesh.firstTriangle + triangle;
  return kTexels ? recordAt(triangleTexels, at).xyz : triangles[at].xyz;
}
/// In the carrier's frame [m].
vec3 pointAt(MeshRest mesh, uint copy, uint i) {
  uint at = mesh.firstPoint + copy * mesh.pointCount + i;
  return kTexels ? vectorAt(pointTexels, at).xyz : points[at].xyz;
}

#endif
