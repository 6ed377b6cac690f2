// Where a scene's bodies, and roots of hairs, are in a frame of an animation that was simulated from it.
#pragma once

#include <vector>

#include "ringlet/scene/body.h"
#include "ringlet/scenes/load_scene.h"

namespace ringlet::program {

/// At the end of a frame, from 1, or a share of one before; one pose a body, in the world.
inline std::vector<BodyPose> bodiesAtFrame(const LoadedScene& scene, double frame) {
  const double seconds = frame / scene.settings.framesPerSecond;
  const HeadPose head = scene.motion.poseAt(seconds);
  return bodyPosesOf(scene.bodies, std::span(&head, 1), std::span(&seconds, 1));
}

/// Where roots of hairs (FullHair, PictureHair) are then, in the world; none where no scalp carries them.
template <class Hair>
std::vector<Vec3d> hairRootsAtFrame(const LoadedScene& scene, const Hair& hair, double frame) {
  const double seconds = frame / scene.settings.framesPerSecond;
  return hair.rootsAt(seconds, scene.motion.poseAt(seconds));
}

}  // namespace ringlet::program
