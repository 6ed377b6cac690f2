// Runs hair as the program does: on one or several devices, by the reference or among ranks; shows its
// progress, and ends early on Ctrl-C.
#pragma once

#include "program/device/device_choice.h"
#include "ringlet/base/result.h"
#include "ringlet/run/run.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet::program {

/// The names of the program's options, for error messages.
RunWords programWords();

/// Where hair is stepped, and what is printed meanwhile.
struct SimulateOptions : RunOptions, DeviceChoice {
  SimulateOptions(RunOptions run = {});

  bool onReference = false;  // instead of on devices
  bool onRanks = false;      // each rank has a part of the hair (mpi/rank_hair.h)
  bool showProgress = true;
  bool tellsFrames = false;  // prints a line of JSON on standard output for each finished frame
  int runNumber = 0;         // number within a sweep, for these lines; 0: no sweep
};

/// Calls runScene; Ctrl-C ends the run early, but properly.
Result<RunOutcome> simulate(const LoadedScene& scene, const SimulateOptions& options,
                            const FrameObserver& observer = {});

}  // namespace ringlet::program
