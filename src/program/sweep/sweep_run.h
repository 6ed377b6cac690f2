// A sweep: runs in one process, on one device, whose kernels are compiled once.
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
  std::filesystem::path folder;  // contains run-0001, run-0002, ..., a folder for each run
  std::string device;            // as SimulateOptions::device
  bool onReference = false;      // instead of on the GPU
  bool usesTuned = true;         // as SimulateOptions::usesTuned
  bool lastOnly = false;         // each run writes last.obj and nothing else
  bool measures = false;         // every frame, as `ringlet measure` does
  bool overwrites = false;       // also finished runs
  bool tellsProgress = false;    // prints a line of JSON on standard output for each frame and run
  bool showProgress = true;
  bool drawsSheet = true;
  int jobs = 2;  // runs at a time: while one is stepped, others are read, prepared and written
  std::size_t part = 1, parts = 1;  // this process does runs part, part + parts, part + 2 parts, ... only
};

/// The state of a run.
enum class RunState { open, finished, kept, failed, interrupted };

/// Some strands of the last frame, for the sheet.
struct SweepCell {
  std::vector<std::uint32_t> firstPoint;  // as in Groom
  std::vector<Vec3f> points;              // [m]; empty: nothing to show
};

struct SweepEntry {
  const SweepRun* run = nullptr;
  RunState state = RunState::open;  // kept: it was finished before this sweep
  bool isOurs = true;               // it belongs to the part that was asked for
  nlohmann::ordered_json report;    // if finished or kept: as in SweepRecord
  int exitCode = 0;
  std::string error;  // if failed: the reason
  SweepCell cell{};
};

/// "finished", "kept", "failed", "interrupted"; "to do" for open.
const char* nameOf(RunState state);

std::filesystem::path folderOf(const SweepRun& run, const SweepOptions& options);

/// The state of the runs before any is started. Errors: a folder holds a finished run with other values; the
/// message says what differs.
Result<std::vector<SweepEntry>> lookAtRuns(std::span<const SweepRun> runs, const SweepOptions& options);

/// Executes the open runs. If one fails, its entry says so and the others go on. Ctrl-C ends the current runs
/// as it ends `ringlet simulate`, and the sweep. Errors: no device.
Status runSweep(std::vector<SweepEntry>& entries, std::span<const SweepAxis> axes,
                const SweepOptions& options);

/// The program's exit status after runSweep(): that of an interruption, if runs are still open; else that of
/// the first run that failed; else that of lost particles.
int exitCodeOf(std::span<const SweepEntry> entries);

}  // namespace ringlet::program
