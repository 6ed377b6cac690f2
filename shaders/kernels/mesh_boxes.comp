// The tree of cloth: a box for each node about its triangles at the time of a copy and at the next, and the corners of
// the triangles of each leaf. Of the last copy the next is itself. An invocation for each node and copy. Mirrors
// nothing: the reference looks at all triangles (reference/equations/cloth_contact.h).
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/mesh_buffers.glsl"
#include "shared/mesh_points.glsl"
#include "shared/workgroup.glsl"

layout(set = 0, binding = kBindMeshWays) writeonly buffer MeshWays { vec4 meshWays[]; };

void main() {
  MeshRest mesh = meshes[parameters.mesh];
  uint nodes = 2u << mesh.levels;
  uint item = parameters.first * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
  uint copy = item / nodes;
  uint node = item % nodes;
  if (copy >= parameters.copies || node == 0) return;
  uint level = findMSB(node);
  uint at = node - (1u << level);
  uint begin = at * mesh.triangleCount >> level;
  uint end = (at + 1) * mesh.triangleCount >> level;
  uint from = parameters.firstCopy + copy;
  uint to = copy + 1 < parameters.copies ? from + 1 : from;
  uint first = mesh.firstWay + from * mesh.waysOfCopy;
  vec3 low = vec3(1e30);
  vec3 high = vec3(-1e30);
  float most = 0.0;
  for (uint triangle = begin; triangle < end; ++triangle) {
    uvec3 corners = cornersOf(mesh, triangle);
    for (int i = 0; i < 3; ++i) {
      vec3 now = pointAt(mesh, from, corners[i]);
      vec3 next = pointAt(mesh, to, corners[i]);
      low = min(low, min(now, next));
      high = max(high, max(now, next));
      most = max(most, length(next - now));
      if (level == mesh.levels) meshWays[first + 2 * nodes + 3 * triangle + i] = vec4(now, 0);
    }
  }
  meshWays[first + 2 * node] = vec4(low, most);
  meshWays[first + 2 * node + 1] = vec4(high, 0);
}
