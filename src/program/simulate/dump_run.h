// `ringlet simulate --dump`: writes a device's buffers after a step, in place of a run.
#pragma once

#include <cstdint>

#include "program/simulate/simulate_run.h"

namespace ringlet::program {

/// Calls dumpStep (ringlet/run/step_dump.h) with step_STEP of the run's folder. Prints where the files are,
/// or the error; returns the exit status.
int runDump(const LoadedScene& scene, const SimulateOptions& options, std::uint64_t step);

}  // namespace ringlet::program
