// HeadPose: where the head is. Roots and root frames are carried by it.
#pragma once

#include "ringlet/base/vec3.h"

namespace ringlet {

/// World from groom: x_world = position + rotate(rotation, x_groom). The rest pose of a groom is HeadPose{}.
struct HeadPose {
  Vec3d position;  // [m]
  Quatd rotation;
  double shift =
      0;  // of roots that move beside the head (InitialState::rootShifts): share of each one's shift
};

/// Pose at fraction s in [0, 1] of the way from a to b: linear in position and shift, slerp in rotation.
inline HeadPose interpolate(const HeadPose& a, const HeadPose& b, double s) {
  return {a.position + (b.position - a.position) * s, slerp(a.rotation, b.rotation, s),
          a.shift + (b.shift - a.shift) * s};
}

}  // namespace ringlet
