// The mesh_* kernels, which make distance grids of meshes that bend: structs, binding numbers, push constants.
#ifndef RINGLET_LAYOUT_MESH_FIELDS
#define RINGLET_LAYOUT_MESH_FIELDS

#include "layout/types.h"

#ifdef __cplusplus
namespace ringlet::layout {
#endif

RINGLET_CONSTANT uint kBindMeshes = 0;          // MeshRest[meshes]
RINGLET_CONSTANT uint kBindMeshTriangles = 1;   // uvec4[triangles of all meshes]: points of the mesh; 0
RINGLET_CONSTANT uint kBindMeshPoints = 2;      // vec4[points]: in the carrier's frame [m]; 0
RINGLET_CONSTANT uint kBindMeshKeys = 3;        // uint[corners]: the nearest triangle and its distance, see meshKey
RINGLET_CONSTANT uint kBindMeshPairs = 4;       // uint[corners]: crossings of columns (mesh_splat), then pairs of
                                                // distances, see gridDistance (mesh_columns)
RINGLET_CONSTANT uint kBindMeshWays = 5;        // vec4[triangles]: xyz: to the next copy [m]; w: by how much the
                                                // way of a corner differs, at most [m]; of cloth its tree
// Triangles and points as texels, with this added to the binding number:
RINGLET_CONSTANT uint kMeshTexels = 10;

// Cloth has no grid; its triangles are the leaves of a tree of boxes, each box about its triangles on their way from
// one copy to the next. Node 1 is the root, node k has the nodes 2 k and 2 k + 1; node k of level l has the triangles
// from ((k - 2^l) triangleCount) >> l to ((k - 2^l + 1) triangleCount) >> l. In the buffer of ways a copy of it is
//   vec4[2 nodes]: low corner, and the longest way of its points to the next copy [m]; high corner; node 0 is empty
//   vec4[3 triangles]: corners
RINGLET_CONSTANT uint kMostInLeaf = 4;

// Corners know their distance to triangles that are closer than this [cells].
RINGLET_CONSTANT float kMeshBand = 2.0;

// A mesh that bends, and its grid; constant. Grids and points come in copies, one for each time at which a grid
// is made: copy i is `corners` words or `pointCount` points behind copy i - 1.
struct MeshRest {
  vec3 gridOrigin;   // in the carrier's frame [m]
  float cell;        // of the grid [m]
  uint cells[3];     // of the grid
  uint corners;      // of the grid
  uint firstTriangle;
  uint triangleCount;
  uint firstPoint;   // of copy 0
  uint pointCount;
  uint firstKey;     // of copy 0
  uint firstPair;    // of copy 0
  uint firstWay;     // of copy 0
  uint triangleBits; // of a key: the numbers of its triangles are below 2^triangleBits
  float snap;        // steps of a cell to which crossings round points
  uint levels;       // of cloth: of its tree, without the root
  uint waysOfCopy;   // words of a copy in the buffer of ways [vec4]
  uint unused;
};

struct MeshParameters {
  uint mesh;
  uint firstCopy;
  uint copies;
  uint first;  // of the workgroups of all dispatches over these copies: this dispatch's first
};

#ifdef __cplusplus
}  // namespace ringlet::layout
#endif
#endif
