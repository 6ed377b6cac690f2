// Signed distances of a mesh's grid from what mesh_splat.comp found: inside is where the surface has been entered
// more often than left on the way along x. Deeper inside than the band, where no triangle is noted, distances go on
// along the column from the nearer end, so that what is there finds a way out. Writes them as gridDistance reads
// them, in place of the crossings. An invocation for each column along x and copy of the grid. Mirrored by
// reference/kernels/mesh_field.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/mesh_buffers.glsl"
#include "shared/mesh_corners.glsl"
#include "shared/workgroup.glsl"

void main() {
  MeshRest mesh = meshes[parameters.mesh];
  uint columns = (mesh.cells[1] + 1) * (mesh.cells[2] + 1);
  uint item = parameters.first * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
  uint copy = item / columns;
  uint rowLength = mesh.cells[0] + 1;
  uint first = (parameters.firstCopy + copy) * mesh.corners + item % columns * rowLength;
  if (copy >= parameters.copies) return;
  // Forwards the distances in place of the crossings, backwards the pairs of them.
  int inside = 0;
  float before = 0.0;
  for (uint x = 0; x < rowLength; ++x) {
    inside += int(meshPairs[mesh.firstPair + first + x]);
    uint key = meshKeys[mesh.firstKey + first + x];
    float distance = distanceOf(mesh, key);
    if (inside > 0) distance = key == 0 ? before - 1.0 : -distance;
    meshPairs[mesh.firstPair + first + x] = floatBitsToUint(distance);
    before = distance;
  }
  uint after = packHalf2x16(vec2(before, 0.0));
  for (uint x = rowLength; x-- > 0;) {
    float distance = uintBitsToFloat(meshPairs[mesh.firstPair + first + x]);
    if (distance < -kMeshBand) distance = max(distance, before - 1.0);
    uint here = packHalf2x16(vec2(distance, 0.0));
    meshPairs[mesh.firstPair + first + x] = here | after << 16;
    before = distance;
    after = here;
  }
}
