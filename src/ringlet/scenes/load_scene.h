// What a scene names, read: the groom, the bodies, whatever moves as a file says.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/groom/loaded_groom.h"
#include "ringlet/motion/head_scalp.h"
#include "ringlet/motion/motion_file.h"
#include "ringlet/rest/material.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/motion.h"
#include "ringlet/scene/settings.h"
#include "ringlet/scenes/scene_file.h"

namespace ringlet {

/// In its unit, the scene's or else the file's, turned to the scene's up axis, placed in the head's frame.
Result<LoadedGroom> loadGroom(const SceneGroom& scene);

/// Of a motion that has a file.
MotionFileChoice motionFileOf(const SceneMotion& motion);

/// All of them, ready to be stepped. `metresPerUnit`: the groom's, and of meshes that state none. Fails with
/// the body's name.
Result<std::vector<Body>> loadBodies(const SceneFile& scene, double metresPerUnit,
                                     std::vector<std::string>& warnings);

/// The scalp of a scene that has one, its groom's roots bound to it. `head`: the head's motion, and the file
/// it is from, if any; where that is the scalp's the two stand in one world, and what the scalp leaves open
/// is the head's.
Result<HeadScalp> loadScalp(const SceneScalp& scene, const Groom& groom, const Motion& head,
                            const std::optional<MotionFileChoice>& headFile, bool upIsZ,
                            std::vector<std::string>& warnings);

/// Where keys are further apart than a head goes in a frame, it jumps: on a smooth way it would only be fast.
void cutJumps(const Settings& settings, Motion& motion);

/// Everything that a run of a scene starts from.
struct LoadedScene {
  Groom groom;
  Material material;  // its dials worked in
  Settings settings;
  Motion motion;
  std::vector<Vec3d> rootShifts{};  // as InitialState takes them
  std::vector<Body> bodies{};
  std::optional<HeadScalp> scalp{};  // that roots follow; none: the head carries them
  double preRollSeconds = 0;
  int frameCount = 48;                  // where the file does not say: the length of keys, or this
  std::vector<std::string> warnings{};  // a sentence each
};

/// Reads all that the file names, and chooses the steps a frame where it leaves them open. Errors: those of
/// the parts; a material that its dials spoil.
Result<LoadedScene> loadScene(const SceneFile& scene);

}  // namespace ringlet
