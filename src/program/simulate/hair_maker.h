// The hair of a run, as its options say: on a device, divided among several or among ranks, or by the
// reference; and taking part in such a run as a rank.
#pragma once

#include <memory>
#include <optional>

#include "program/simulate/simulate_run.h"
#include "ringlet/base/result.h"
#include "ringlet/run/scene_hair.h"

namespace ringlet::program {

/// Errors: those of the device and of the hair; more devices than strands.
Result<std::unique_ptr<SceneHair>> makeHair(const SceneHairInput& input, const SimulateOptions& options);

/// Whether mpirun started more than this process.
bool isOneOfRanks();
/// Under mpirun: takes part in the run that `simulate` begins on rank 0. An exit status: this is another
/// rank, and the run is over.
std::optional<int> joinRun(const LoadedScene& scene, SimulateOptions& options);

}  // namespace ringlet::program
