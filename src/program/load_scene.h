// What a scene names, read: the groom, the bodies, whatever moves as a file says.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "program/motion_file.h"
#include "ringlet/base/result.h"
#include "ringlet/groom/loaded_groom.h"
#include "ringlet/motion/head_scalp.h"
#include "ringlet/output/up_axis.h"
#include "ringlet/scene/body.h"
#include "ringlet/scenes/scene_file.h"

namespace ringlet::program {

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
                            const std::optional<MotionFileChoice>& headFile, UpAxis up,
                            std::vector<std::string>& warnings);

}  // namespace ringlet::program
