// The sheet.png of a run, drawn by the renderer: full hair with light, shadows and the run's bodies.
#pragma once

#include "program/simulate/simulate_run.h"
#include "ringlet/base/result.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet::program {

/// Fails if the run writes no animation whose points contain the head's motion.
Status checkRenderedSheet(const RunOptions& options);

/// Call after a run of the scene with at least one frame. Replaces the sheet that the run has drawn; if this
/// fails, that one stays. Cost: six pictures, a second each on lavapipe, and compiling the renderer's
/// kernels.
Status writeRenderedSheet(const LoadedScene& scene, const SimulateOptions& options);

}  // namespace ringlet::program
