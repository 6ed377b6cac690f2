// `ringlet simulate --dump`: the buffers of a device after a step, in place of a run.
#pragma once

#include <cstdint>

#include "program/simulate/simulate_run.h"

namespace ringlet::program {

/// dumpStep (ringlet/run/step_dump.h) into step_STEP of the run's folder. Says where, or why not; the exit
/// status.
int runDump(const LoadedScene& scene, const SimulateOptions& options, std::uint64_t step);

}  // namespace ringlet::program
