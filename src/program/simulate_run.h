// One run of `ringlet simulate`: reads the groom, steps it frame by frame, writes what comes out.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/output/up_axis.h"
#include "ringlet/rest/material.h"
#include "ringlet/scene/motion.h"
#include "ringlet/scene/settings.h"
#include "ringlet/solver/simulation.h"

namespace ringlet::program {

/// What the user asked for, checked.
struct SimulateOptions {
  std::filesystem::path groom;
  std::filesystem::path folder;  // for the results
  int frameCount = 48;
  double metresPerUnit = 0.01;  // of the groom's file, and of what is written
  UpAxis up = UpAxis::y;
  double width = 0.0005;  // diameter of strands in hair.usda [m]
  Motion motion;
  Settings settings;
  Material material;
  bool onReference = false;  // rather than on the GPU
  std::string device;
  KernelChoice kernel;
  bool showProgress = true;
};

/// What came of it. Times are wall clock, per finished frame [ms].
struct SimulateOutcome {
  int frameCount = 0;  // finished
  std::size_t strandCount = 0, particleCount = 0;
  double millisecondsPerFrame = 0;  // stepping only
  std::map<std::string, double>
      stages;  // by the device's own clock where it has one; readback, write by the wall
  SimulationReport report;
  std::string device, driver, kernel;
  std::string positionsHash;  // of the last frame
  bool interrupted = false;
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> outputs;
};

/// Fails with one sentence; frames finished before a failure are kept. Ctrl-C ends it early, but well.
Result<SimulateOutcome> runSimulation(const SimulateOptions& options);

}  // namespace ringlet::program
