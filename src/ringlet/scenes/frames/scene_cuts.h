// Strands that are cut while hair moves: [[cut]] of a scene file.
#pragma once

#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"
#include "ringlet/scene/strand_cut.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet {

/// What is cut at a time, as Simulation::cut takes it.
struct TimedCuts {
  double seconds = 0;
  std::vector<StrandCut> cuts;
};

/// By rising time, those of one time together; of several that cut a strand, all that leave it shorter than
/// those before. Errors, with the cut's name: strands that the groom does not have.
Result<std::vector<TimedCuts>> cutsOf(const SceneFile& scene, const Groom& groom, int rootCount);

}  // namespace ringlet
