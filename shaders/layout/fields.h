// Force fields, and fields of moving air: structs, binding numbers.
#ifndef RINGLET_LAYOUT_FIELDS
#define RINGLET_LAYOUT_FIELDS

#include "layout/types.h"

#ifdef __cplusplus
namespace ringlet::layout {
#endif

// Bindings of the strand_step kernels, set 0.
RINGLET_CONSTANT uint kBindFields = 35;        // StepField[steps][fields]
RINGLET_CONSTANT uint kBindFieldNodes = 36;    // vec4[nodes]: xyz: velocity of the air, the grid's axes [m/s]
RINGLET_CONSTANT uint kBindFieldTexels = 37;   // 7 a field
RINGLET_CONSTANT uint kBindFieldNodeTexels = 38;

// A field in a step, along world axes, relative to the head's origin at the step's start. See
// equations/force_field.glsl. Strengths are accelerations [m/s^2] or, with drag, velocities of the air [m/s].
struct StepField {
  vec3 place;       // [m]
  float axial;      // along the axis
  vec3 axis;        // unit vector
  float radial;     // away from the place, or from the axis
  vec3 still;       // velocity of air at rest, relative to the head's translation [m/s]
  float around;     // about the axis
  float aboutAxis;  // 1: distances are from the axis; 0: from the place
  float core;       // closer than this, radial and around fade to 0 [m]
  float perReach;   // 1 / the distance at which the field ends [1/m]; 0: it has no end
  float drag;       // [1/s]
  float front;      // radius of a shell outside of which the field is 0 [m]
  float perThickness;  // 1 / half of the shell's thickness [1/m]; 0: there is no shell
  float gridShare;     // factor on the grid's velocities
  float cell;          // of the grid [m]; its node 0 is at the place
  vec4 rotation;       // of the grid's axes: quaternion (x, y, z, w)
  uint nodes[3];       // of the grid; 0: there is none
  uint firstNode;
};
RINGLET_CONSTANT uint kFieldRecords = 7;  // of 16 bytes

#ifdef __cplusplus
}  // namespace ringlet::layout
#endif
#endif
