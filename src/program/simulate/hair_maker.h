// Makes the hair of a run as its options say: on a device, divided among devices or ranks, or by the
// reference; and takes part in such a run as a rank.
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
/// Under mpirun: takes part in the run that `simulate` begins on rank 0. Returns an exit status if this is
/// another rank, once the run is over.
std::optional<int> joinRun(const LoadedScene& scene, SimulateOptions& options);

}  // namespace ringlet::program
