// The corners of grids of meshes that bend: keys, crossings, pairs.
#ifndef RINGLET_MESH_CORNERS
#define RINGLET_MESH_CORNERS

#include "layout/mesh_fields.h"

layout(set = 0, binding = kBindMeshKeys) buffer MeshKeys { uint meshKeys[]; };
layout(set = 0, binding = kBindMeshPairs) buffer MeshPairs { uint meshPairs[]; };

// A key: how near the nearest triangle is, in steps of the band, in the upper bits; then the triangle, counted
// from the last. A larger key is nearer; of triangles equally near the first counts; 0: none is within the band.
uint mostSteps(MeshRest mesh) { return (1u << (32 - mesh.triangleBits)) - 2; }
uint meshKey(MeshRest mesh, float distance, uint triangle) {
  uint steps = min(uint(distance / kMeshBand * float(mostSteps(mesh))), mostSteps(mesh));
  return (mostSteps(mesh) + 1 - steps) << mesh.triangleBits | ((1u << mesh.triangleBits) - 1 - triangle);
}
/// In cells; kMeshBand without a triangle.
float distanceOf(MeshRest mesh, uint key) {
  uint steps = mostSteps(mesh) + 1 - (key >> mesh.triangleBits);
  return key == 0 ? kMeshBand : kMeshBand * (float(steps) / float(mostSteps(mesh)));
}

#endif
