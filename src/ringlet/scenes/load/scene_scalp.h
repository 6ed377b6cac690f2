// What a scene says of a scalp, with its mesh read and the groom's roots bound to it.
#pragma once

#include "ringlet/base/result.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// Reads the scalp's mesh, or takes that of the body it names, and sets loaded.scalp. What of `loaded` it
/// needs is there: groom, motion, settings, bodies that bend. Errors: those of readMeshMotion and
/// HeadScalp::bind. Warnings go to loaded.warnings.
Status loadScalp(const SceneFile& file, LoadedScene& loaded);

}  // namespace ringlet
