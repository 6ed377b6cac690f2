// What a triangle of a mesh adds to the mesh's grid: to corners within the band, the triangle, if none is nearer;
// to columns of corners along x that go through it, the crossing, at the first corner beyond. A workgroup for each
// triangle and copy of the grid; an invocation takes rows of corners along x, every n-th. Sums and maxima are of
// integers, so their order does not matter. Mirrored by reference/kernels/mesh_field.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "equations/column_crossing.glsl"
#include "equations/triangle_distance.glsl"
#include "shared/mesh_buffers.glsl"
#include "shared/mesh_corners.glsl"
#include "shared/mesh_points.glsl"
#include "shared/workgroup.glsl"

const float kMostSteps = 8192.0;  // between the grid's middle and a point across a column, see columnCrossing

// In cells, from the grid's origin.
vec3 inCells(MeshRest mesh, vec3 p) { return (p - mesh.gridOrigin) / mesh.cell; }

void main() {
  MeshRest mesh = meshes[parameters.mesh];
  uint item = parameters.first + gl_WorkGroupID.x;
  uint copy = parameters.firstCopy + item / mesh.triangleCount;
  uint triangle = item % mesh.triangleCount;
  uvec3 corners = cornersOf(mesh, triangle);
  vec3 a = inCells(mesh, pointAt(mesh, copy, corners.x));
  vec3 b = inCells(mesh, pointAt(mesh, copy, corners.y));
  vec3 c = inCells(mesh, pointAt(mesh, copy, corners.z));
  vec3 counts = vec3(mesh.cells[0], mesh.cells[1], mesh.cells[2]);

  // Across columns, in steps from the grid's middle.
  vec2 middle = floor(0.5 * counts.yz);
  ivec2 stepsA = ivec2(round(clamp((a.yz - middle) * mesh.snap, -kMostSteps, kMostSteps)));
  ivec2 stepsB = ivec2(round(clamp((b.yz - middle) * mesh.snap, -kMostSteps, kMostSteps)));
  ivec2 stepsC = ivec2(round(clamp((c.yz - middle) * mesh.snap, -kMostSteps, kMostSteps)));

  vec3 low = max(ceil(min(min(a, b), c) - kMeshBand), vec3(0));
  vec3 high = min(floor(max(max(a, b), c) + kMeshBand), counts);
  bool isBeside = low.y > high.y || low.z > high.z;
  uint rowsAlongY = uint(isBeside ? 0.0 : high.y - low.y + 1.0);
  uint rows = rowsAlongY * uint(isBeside ? 0.0 : high.z - low.z + 1.0);
  uint firstX = uint(min(low.x, counts.x));
  uint endX = low.x > high.x ? firstX : uint(high.x) + 1;
  uint rowLength = mesh.cells[0] + 1;
  for (uint row = gl_LocalInvocationID.x; row < rows; row += gl_WorkGroupSize.x) {
    uint z = row / rowsAlongY + uint(low.z);
    uint y = row % rowsAlongY + uint(low.y);
    uint firstCorner = copy * mesh.corners + rowLength * (y + (mesh.cells[1] + 1) * z);
    vec3 place = vec3(0, y, z);
    for (uint x = firstX; x < endX; ++x) {
      place.x = float(x);
      float distance = length(wayFromTriangle(place, a, b, c));
      if (distance <= kMeshBand)
        atomicMax(meshKeys[mesh.firstKey + firstCorner + x], meshKey(mesh, distance, triangle));
    }
    ivec2 column = ivec2((place.yz - middle) * mesh.snap);
    ColumnCrossing crossing = columnCrossing(stepsA, stepsB, stepsC, vec3(a.x, b.x, c.x), column);
    float beyond = max(floor(crossing.x) + 1.0, 0.0);
    if (crossing.turns != 0 && beyond <= counts.x)
      atomicAdd(meshPairs[mesh.firstPair + firstCorner + uint(beyond)], uint(crossing.turns));
  }
}
