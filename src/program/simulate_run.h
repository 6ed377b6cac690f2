// A run of hair as the program has it: on a device, on several, by the reference or among ranks; with its
// progress shown, and ended by Ctrl-C.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/run/run.h"
#include "ringlet/scenes/load_scene.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/kernel_choice.h"

namespace ringlet::program {

/// The program's options for what errors advise.
RunWords programWords();

/// Where hair is stepped, and what is told meanwhile.
struct SimulateOptions : RunOptions {
  SimulateOptions(RunOptions run = {});

  bool onReference = false;  // rather than on the GPU
  bool onRanks = false;      // each has a part of the hair (rank_hair.h)
  std::string device;
  std::vector<std::string> devices;     // in its place: on which the strands are divided
  std::optional<ComputeDevice> opened;  // in its place: runs on one device share its compiled kernels
  KernelChoice kernel;
  bool usesTuned = true;  // strand shapes by what `ringlet tune` measured
  bool showProgress = true;
  bool tellsFrames = false;  // a line of JSON a finished frame, on standard output
  int runNumber = 0;         // of a sweep, which these lines say; 0: of none
};

/// runScene, which Ctrl-C ends early, but well.
Result<RunOutcome> simulate(const LoadedScene& scene, const SimulateOptions& options,
                            const FrameObserver& observer = {});

}  // namespace ringlet::program
