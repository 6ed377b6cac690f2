// The hair of a run, as its options say: on a device, divided among several or among ranks, or by the
// reference.
#pragma once

#include <memory>
#include <optional>

#include "program/simulate/simulate_run.h"
#include "ringlet/base/result.h"
#include "ringlet/run/scene_hair.h"

namespace ringlet::program {

/// Errors: those of the device and of the hair; more devices than strands.
Result<std::unique_ptr<SceneHair>> makeHair(const SceneHairInput& input, const SimulateOptions& options);

}  // namespace ringlet::program
