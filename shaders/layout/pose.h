// The pose_* kernels: structs, binding numbers, push constants.
#ifndef RINGLET_LAYOUT_POSE
#define RINGLET_LAYOUT_POSE

#include "layout/types.h"

#ifdef __cplusplus
namespace ringlet::layout {
#endif

// Bindings of the pose_* kernels: they pass on positions of simulated hair to whatever follows or draws it on
// the same device.
RINGLET_CONSTANT uint kBindPosePositions = 0;  // vec4[particles]: position [m], 0; in the solver's order
RINGLET_CONSTANT uint kBindPosePlaces = 1;     // PosePlace[particles]
RINGLET_CONSTANT uint kBindPosePoints = 2;     // uvec4[points]: bits of the position, PosePlace::tag
RINGLET_CONSTANT uint kBindPoseBounds = 3;     // PoseBounds
RINGLET_CONSTANT uint kPoseBindingCount = 4;
// The positions as texels, with this added to the binding number:
RINGLET_CONSTANT uint kPoseTexels = 10;

// Constant per particle.
struct PosePlace {
  uint point;  // index of its point
  uint tag;    // fourth word of its point
};

struct PoseParameters {
  vec4 turn;  // quaternion: applied to particles
  uint count;
  uint isTurned;
};

// The largest x, y and z of all points, then the largest -x, -y and -z, as ordered bits (pose_bounds.comp),
// so that 0 is below all.
struct PoseBounds {
  uint high[3];
  uint low[3];
};

#ifdef __cplusplus
}  // namespace ringlet::layout
#endif
#endif
