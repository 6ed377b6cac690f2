// The pose_* kernels: structs, binding numbers, push constants.
#ifndef RINGLET_LAYOUT_POSE
#define RINGLET_LAYOUT_POSE

#include "layout/types.h"

#ifdef __cplusplus
namespace ringlet::layout {
#endif

// Bindings of the pose_* kernels: where simulated hair is, for what follows or draws it on the same device.
RINGLET_CONSTANT uint kBindPosePositions = 0;  // vec4[particles]: position [m], 0; as the solver has them
RINGLET_CONSTANT uint kBindPosePlaces = 1;     // PosePlace[particles]
RINGLET_CONSTANT uint kBindPosePoints = 2;     // uvec4[points]: position's bits, PosePlace::tag
RINGLET_CONSTANT uint kBindPoseBounds = 3;     // PoseBounds
RINGLET_CONSTANT uint kPoseBindingCount = 4;
// The positions as texels, this much further:
RINGLET_CONSTANT uint kPoseTexels = 10;

// Constant per particle.
struct PosePlace {
  uint point;  // where it goes
  uint tag;    // what stands behind its position there
};

struct PoseParameters {
  vec4 turn;  // quaternion: of particles that the head carries
  uint count;
  uint isTurned;
};

// The highest of all points along x, y, z, then how low the lowest are; as ordered bits (pose_bounds.comp), so that
// 0 is below all.
struct PoseBounds {
  uint high[3];
  uint low[3];
};

#ifdef __cplusplus
}  // namespace ringlet::layout
#endif
#endif
