// The poses of a scene's bodies, and the roots of its hairs, in a frame of an animation simulated from it.
#pragma once

#include <vector>

#include "ringlet/scene/body.h"
#include "ringlet/scenes/frames/scene_frames.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// At the end of a frame, which counts from 1 and may be fractional: one pose per body, in the world.
inline std::vector<BodyPose> bodiesAtFrame(const LoadedScene& scene, double frame) {
  return SceneFrames(scene).bodiesAt(frame);
}

/// The roots of hairs (FullHair, PictureHair) at that time, in the world; empty if no scalp carries them.
template <class Hair>
std::vector<Vec3d> hairRootsAtFrame(const LoadedScene& scene, const Hair& hair, double frame) {
  const double seconds = SceneFrames(scene).secondsAt(frame);
  return hair.rootsAt(seconds, scene.motion.poseAt(seconds));
}

}  // namespace ringlet
