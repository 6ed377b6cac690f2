// What a scene names, read: the groom, the bodies, whatever moves as a file says.
#pragma once

#include <string>
#include <vector>

#include "program/motion_file.h"
#include "ringlet/base/result.h"
#include "ringlet/groom/loaded_groom.h"
#include "ringlet/scene/body.h"
#include "ringlet/scenes/scene_file.h"

namespace ringlet::program {

/// In its unit, placed in the head's frame.
Result<LoadedGroom> loadGroom(const SceneGroom& scene);

/// Of a motion that has a file.
MotionFileChoice motionFileOf(const SceneMotion& motion);

/// All of them, ready to be stepped. Fails with the body's name.
Result<std::vector<Body>> loadBodies(const SceneFile& scene, std::vector<std::string>& warnings);

}  // namespace ringlet::program
