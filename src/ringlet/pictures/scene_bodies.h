// The bodies of a scene, and the roots of its hairs, in a frame of an animation simulated from it.
#pragma once

#include <span>
#include <vector>

#include "ringlet/pictures/follow_mover.h"
#include "ringlet/scene/body.h"
#include "ringlet/scenes/frames/scene_frames.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// At the end of a frame, which counts from 1 and may be fractional: one pose per body, in the world.
inline std::vector<BodyPose> bodiesAtFrame(const LoadedScene& scene, double frame) {
  return SceneFrames(scene).bodiesAt(frame);
}

/// What hairs that follow have about them at that time.
struct FollowScene {
  std::vector<BodyPose> bodies;
  std::vector<std::vector<Vec3d>> bodyPoints;
  std::vector<Vec3d> roots;  // in the world; empty if no scalp carries them

  StrandsPose pose(std::span<const Vec3f> points) const { return {points, bodies, bodyPoints, roots}; }
};
/// Of hairs (FullHair, PictureHair).
template <class Hair>
FollowScene followSceneAtFrame(const LoadedScene& scene, const Hair& hair, double frame) {
  const SceneFrames frames(scene);
  const double seconds = frames.secondsAt(frame);
  return {frames.bodiesAt(frame), frames.bodyPointsAt(frame),
          hair.rootsAt(seconds, scene.motion.poseAt(seconds))};
}

}  // namespace ringlet
