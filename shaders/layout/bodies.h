// Bodies that hair collides with, and the air: structs, binding numbers.
#ifndef RINGLET_LAYOUT_BODIES
#define RINGLET_LAYOUT_BODIES

#include "layout/types.h"

#ifdef __cplusplus
namespace ringlet::layout {
#endif

// Bindings in set 0, of strand_step and of other kernels that use bodies.
RINGLET_CONSTANT uint kBindBodies = 15;      // BodyRest[bodies]
RINGLET_CONSTANT uint kBindBodyPoses = 16;   // BodyPose[steps + 1][bodies]
RINGLET_CONSTANT uint kBindGridPairs = 17;   // uint[corners of all grids]: pairs of distances, see gridDistance
RINGLET_CONSTANT uint kBindAir = 18;         // StepAir[steps]
RINGLET_CONSTANT uint kBindWindModes = 19;   // WindWave[kWindWaves]
RINGLET_CONSTANT uint kBindBodyTexels = 20;  // 6 a body
RINGLET_CONSTANT uint kBindBodyPoseTexels = 21;  // 4 a pose
RINGLET_CONSTANT uint kBindGridPairTexels = 22;  // four pairs each
RINGLET_CONSTANT uint kBindAirTexels = 23;       // 4 a step
RINGLET_CONSTANT uint kBindWindModeTexels = 24;  // 2 a mode
RINGLET_CONSTANT uint kBindBodyKeys = 42;    // uint[corners of bodies that bend]: see meshKey
RINGLET_CONSTANT uint kBindBodyWays = 43;    // vec4[triangles of bodies that bend], see BodyPose::field; of cloth its
                                             // tree, see mesh_fields.h
RINGLET_CONSTANT uint kBindBodyKeyTexels = 44;  // four keys each
RINGLET_CONSTANT uint kBindBodyWayTexels = 45;
RINGLET_CONSTANT uint kBindClothLists = 46;  // ClothList[cloth][particles]

RINGLET_CONSTANT uint kWindWaves = 12;   // modes of the turbulent wind; a multiple of 4

// A body; constant. Spheres and capsules are boxes with rounded edges too.
struct BodyRest {
  vec3 halfExtents;  // of the inner box [m]
  float rounding;    // of the box, or the distance that hair keeps from a plane or grid [m]
  vec4 bounds;       // bounding sphere: xyz: centre, in the body's own axes [m]; w: radius [m]
  vec3 gridOrigin;   // [m]
  float cell;        // of the grid [m]
  uint cells[3];     // of the grid
  uint firstPair;    // of its grid's corners
  float friction;
  uint shape;         // kShape...
  // Of a body that bends: of copy 0 of its field.
  uint firstKey;
  uint triangleBits;  // of a key, see MeshRest; of cloth the levels of its tree
  uint firstWay;
  uint triangleCount;
  // Of cloth: lists[0] is which of all cloth it is. A kernel that asks what a particle or the two ends of an edge know
  // of it puts the numbers of their lists here (ClothList).
  uint lists[2];
};
RINGLET_CONSTANT uint kShapeBox = 0;
RINGLET_CONSTANT uint kShapePlane = 1;
RINGLET_CONSTANT uint kShapeGrid = 2;
RINGLET_CONSTANT uint kShapeField = 3;  // of a body that bends: grids made anew while it moves, see mesh_fields.h
RINGLET_CONSTANT uint kShapeCloth = 4;  // of cloth, which has hair on both sides: its triangles, in a tree

// The triangles of cloth that a particle may meet in a step (shared/cloth_lists.glsl).
RINGLET_CONSTANT uint kClothListed = 31;  // at most
struct ClothList {
  vec3 from;    // where its way starts, in the frame of what carries the cloth [m]
  float reach;  // how far from the way all triangles are known [m]
  vec3 along;   // the way, in the frame that moves on with the cloth there [m]
  float field;  // of the cloth at the step's start, see BodyPose
  vec3 way;     // of that frame, which is that of the nearest place, to the cloth's next copy [m]
  float distance;  // of the nearest place at the step's start, at most kClothReach [m]
  uint count;
  uint triangles[kClothListed];
};

// The pose of a body, relative to the head's origin, along world axes. Pose 0 is the frame's start, 1 + k the
// end of step k.
struct BodyPose {
  vec3 position;  // [m]
  float moves;    // largest distance by which a point of it moves in the step that ends here [m]
  vec4 rotation;  // quaternion (x, y, z, w)
  vec4 turn;      // rotation from the pose before to this one
  vec3 velocity;  // of its origin in that step, relative to the head's translation [m/s]
  float field;    // of a body that bends: which copy of its field is meant, and by which share of the way to the
                  // next copy the surface has moved on since
};

// The air in a step, relative to the head's translation.
struct StepAir {
  vec4 wind;       // xyz: without turbulence [m/s]
  vec4 phases[3];  // of its waves, at the head's origin [rad]
};
// A mode of the turbulent wind.
struct WindWave {
  vec4 wave;       // xyz [rad/m]
  vec4 amplitude;  // xyz [m/s]
};

#ifdef __cplusplus
}  // namespace ringlet::layout
#endif
#endif
