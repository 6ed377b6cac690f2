// How triangles of a mesh move from the time of one copy of its grid to the next: the mean way of a triangle's
// points, and by how much they differ from it. Of the last copy it is none. An invocation for each triangle and
// copy. Mirrored by reference/kernels/mesh_field.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/mesh_buffers.glsl"
#include "shared/mesh_points.glsl"
#include "shared/workgroup.glsl"

layout(set = 0, binding = kBindMeshWays) writeonly buffer MeshWays { vec4 meshWays[]; };

void main() {
  MeshRest mesh = meshes[parameters.mesh];
  uint item = parameters.first * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
  uint copy = item / mesh.triangleCount;
  uint triangle = item % mesh.triangleCount;
  if (copy >= parameters.copies) return;
  uvec3 corners = cornersOf(mesh, triangle);
  uint from = parameters.firstCopy + copy;
  uint to = copy + 1 < parameters.copies ? from + 1 : from;
  vec3 ways[3];
  for (int i = 0; i < 3; ++i) ways[i] = pointAt(mesh, to, corners[i]) - pointAt(mesh, from, corners[i]);
  vec3 way = (ways[0] + ways[1] + ways[2]) / 3.0;
  float spread = max(length(ways[0] - way), max(length(ways[1] - way), length(ways[2] - way)));
  meshWays[mesh.firstWay + from * mesh.waysOfCopy + triangle] = vec4(way, spread);
}
