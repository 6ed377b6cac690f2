// A run of hair as the program has it: on a device, on several, by the reference or among ranks; with its
// progress shown, and ended by Ctrl-C.
#pragma once

#include "program/device/device_choice.h"
#include "ringlet/base/result.h"
#include "ringlet/run/run.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet::program {

/// The program's options for what errors advise.
RunWords programWords();

/// Where hair is stepped, and what is told meanwhile.
struct SimulateOptions : RunOptions, DeviceChoice {
  SimulateOptions(RunOptions run = {});

  bool onReference = false;  // rather than on devices
  bool onRanks = false;      // each has a part of the hair (mpi/rank_hair.h)
  bool showProgress = true;
  bool tellsFrames = false;  // a line of JSON a finished frame, on standard output
  int runNumber = 0;         // of a sweep, which these lines say; 0: of none
};

/// runScene, which Ctrl-C ends early, but well.
Result<RunOutcome> simulate(const LoadedScene& scene, const SimulateOptions& options,
                            const FrameObserver& observer = {});

}  // namespace ringlet::program
