// Where a scene's bodies, and roots of hairs, are in a frame of an animation that was simulated from it.
#pragma once

#include <vector>

#include "ringlet/scene/body.h"
#include "ringlet/scenes/frames/scene_frames.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// At the end of a frame, from 1, or a share of one before; one pose a body, in the world.
inline std::vector<BodyPose> bodiesAtFrame(const LoadedScene& scene, double frame) {
  return SceneFrames(scene).bodiesAt(frame);
}

/// Where roots of hairs (FullHair, PictureHair) are then, in the world; none where no scalp carries them.
template <class Hair>
std::vector<Vec3d> hairRootsAtFrame(const LoadedScene& scene, const Hair& hair, double frame) {
  const double seconds = SceneFrames(scene).secondsAt(frame);
  return hair.rootsAt(seconds, scene.motion.poseAt(seconds));
}

}  // namespace ringlet
