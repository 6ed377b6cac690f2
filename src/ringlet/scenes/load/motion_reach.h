// How much of a run the head's motion reaches: one that ends before it, or that only jumps, moves hair less
// than its user expects.
#pragma once

#include <string>
#include <vector>

#include "ringlet/scene/body.h"
#include "ringlet/scene/motion.h"
#include "ringlet/scene/settings.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet {

/// A sentence for each motion of a file that ends before the run, and one where the head jumps
/// (Settings::teleportDistance) in a tenth of the frames or more, in which no hair is simulated. bodies: as
/// many as the scene has. Cost: a look at each frame.
std::vector<std::string> motionReach(const SceneFile& scene, const Motion& head,
                                     const std::vector<Body>& bodies, const Settings& settings,
                                     int frameCount);

}  // namespace ringlet
