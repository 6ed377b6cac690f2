// sheet.png of a run as the renderer draws it: full hair, with light, shadows and the run's bodies.
#pragma once

#include "program/simulate/simulate_run.h"
#include "ringlet/base/result.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet::program {

/// Why a run with these options can have none: it writes no animation with the head's motion in its points.
Status checkRenderedSheet(const RunOptions& options);

/// After a run of the scene with at least one frame: in place of the sheet that it has drawn, which stays
/// where this fails. Cost: six pictures, a second each on lavapipe, and its kernels.
Status writeRenderedSheet(const LoadedScene& scene, const SimulateOptions& options);

}  // namespace ringlet::program
