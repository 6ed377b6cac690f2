// What a scene says of a body that bends, with its mesh read and a grid about where hair can be.
#pragma once

#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/motion/moving_body.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// Reads or makes the mesh of body `index` of `file`, which bends, and makes loaded.bodies[index]
/// follow it. What of `loaded` it needs is there: groom, motion, bodies, settings. Errors: those of
/// readMeshMotion; a mesh that hair does not come near. Warnings go to loaded.warnings.
Status loadBendingBody(const SceneFile& file, std::size_t index, LoadedScene& loaded);

}  // namespace ringlet
