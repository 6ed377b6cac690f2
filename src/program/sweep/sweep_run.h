// A sweep: its runs in one process, on one device whose kernels are compiled once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "program/sweep/sweep_plan.h"
#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"

namespace ringlet::program {

struct SweepOptions {
  std::filesystem::path folder;  // each run has run-0001, run-0002, ... in it
  std::string device;            // as SimulateOptions::device
  bool onReference = false;      // rather than on the GPU
  bool usesTuned = true;         // as SimulateOptions::usesTuned
  bool lastOnly = false;         // of each run last.obj, and nothing else
  bool measures = false;         // every frame, as `ringlet measure` does
  bool overwrites = false;       // finished runs too
  bool tellsProgress = false;    // a line of JSON a frame and a run, on standard output
  bool showProgress = true;
  bool drawsSheet = true;
  int jobs = 2;  // runs at a time: one is read, prepared and written while another is stepped
  std::size_t part = 1, parts = 1;  // only the runs of this part, counted out in turn
};

/// What became of a run.
enum class RunState { open, finished, kept, failed, interrupted };

/// Some strands of the last frame, for the sheet.
struct SweepCell {
  std::vector<std::uint32_t> firstPoint;  // as in Groom
  std::vector<Vec3f> points;              // [m]; none: nothing to show
};

struct SweepEntry {
  const SweepRun* run = nullptr;
  RunState state = RunState::open;  // kept: it was finished before
  bool isOurs = true;               // of the part that was asked for
  nlohmann::ordered_json report;    // finished or kept: as SweepRecord has it
  int exitCode = 0;
  std::string error;  // failed: why
  SweepCell cell{};
};

/// finished, kept, failed, interrupted; open: "to do".
const char* nameOf(RunState state);

std::filesystem::path folderOf(const SweepRun& run, const SweepOptions& options);

/// What is known of the runs without running any. Errors: a folder holds a finished run of other values, with
/// what differs.
Result<std::vector<SweepEntry>> lookAtRuns(std::span<const SweepRun> runs, const SweepOptions& options);

/// Runs what is open; a run that fails says so in its entry, and the others go on. Ctrl-C ends the run under
/// way as it ends `ringlet simulate`, and the sweep. Errors: no device.
Status runSweep(std::vector<SweepEntry>& entries, std::span<const SweepAxis> axes,
                const SweepOptions& options);

/// Of the program, once runSweep() is done: that of an interruption, which runs that are still open tell too,
/// else of the first run that failed, else of particles that were lost.
int exitCodeOf(std::span<const SweepEntry> entries);

}  // namespace ringlet::program
