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
RINGLET_CONSTANT uint kBindGridCells = 17;   // uvec4[cells]: the distances of a cell's corners, see gridDistance
RINGLET_CONSTANT uint kBindAir = 18;         // StepAir[steps]
RINGLET_CONSTANT uint kBindWindModes = 19;   // WindWave[kWindWaves]
RINGLET_CONSTANT uint kBindBodyTexels = 20;  // 5 a body
RINGLET_CONSTANT uint kBindBodyPoseTexels = 21;  // 4 a pose
RINGLET_CONSTANT uint kBindGridCellTexels = 22;
RINGLET_CONSTANT uint kBindAirTexels = 23;       // 4 a step
RINGLET_CONSTANT uint kBindWindModeTexels = 24;  // 2 a mode

RINGLET_CONSTANT uint kWindWaves = 12;   // modes of the turbulent wind; a multiple of 4

// A body; constant. Spheres and capsules are boxes with rounded edges too.
struct BodyRest {
  vec3 halfExtents;  // of the inner box [m]
  float rounding;    // of the box, or the distance that hair keeps from a plane or grid [m]
  vec4 bounds;       // bounding sphere: xyz: centre, in the body's own axes [m]; w: radius [m]
  vec3 gridOrigin;   // [m]
  float cell;        // of the grid [m]
  uint cells[3];     // of the grid
  uint firstCell;
  float friction;
  uint shape;        // kShapeBox, kShapePlane or kShapeGrid
  uint unused[2];
};
RINGLET_CONSTANT uint kShapeBox = 0;
RINGLET_CONSTANT uint kShapePlane = 1;
RINGLET_CONSTANT uint kShapeGrid = 2;

// The pose of a body, relative to the head's origin, along world axes. Pose 0 is the frame's start, 1 + k the
// end of step k.
struct BodyPose {
  vec3 position;  // [m]
  float moves;    // largest distance by which a point of it moves in the step that ends here [m]
  vec4 rotation;  // quaternion (x, y, z, w)
  vec4 turn;      // rotation from the pose before to this one
  vec4 velocity;  // xyz: of its origin in that step, relative to the head's translation [m/s]
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
