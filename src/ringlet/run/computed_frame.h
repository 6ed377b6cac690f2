// ComputedFrame: a frame of a run, as it comes from the hair.
#pragma once

#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/head_pose.h"

namespace ringlet {

struct ComputedFrame {
  int number = 0;                // 1 for the first
  std::vector<Vec3f> positions;  // as SceneHair::framePositions gives them
  HeadPose head;
  std::vector<BodyPose> bodies;  // at its end
};

}  // namespace ringlet
