// ComputedFrame: a computed frame of a run.
#pragma once

#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/head_pose.h"

namespace ringlet {

struct ComputedFrame {
  int number = 0;                // 1 for the first
  std::vector<Vec3f> positions;  // as SceneHair::framePositions returns them
  HeadPose head;
  std::vector<BodyPose> bodies;  // poses at the frame's end
  std::vector<std::vector<Vec3d>>
      points{};  // of the meshes of bodies that bend, in the world at the frame's end
};

}  // namespace ringlet
