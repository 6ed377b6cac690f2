// Hair of a run that several ranks (ranks.h) have a part of each; on one of the run's devices, in turn.
#pragma once

#include <memory>

#include "program/simulate_run.h"
#include "ringlet/base/result.h"
#include "ringlet/run/scene_hair.h"

namespace ringlet::program {

/// Of rank 0: all of the hair. Errors: as makeHair; of any rank.
Result<std::unique_ptr<SceneHair>> makeRankHair(const SceneHairInput& input, const SimulateOptions& options);

/// Of another rank: does with its part what rank 0 tells it to, until that tells it to leave. What goes wrong
/// is said by rank 0. Returns an exit status.
int serveRanks(const LoadedScene& scene, const SimulateOptions& options);

}  // namespace ringlet::program
