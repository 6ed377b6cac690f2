// TraceFile: the time of each dispatch of a run's frames on the device, in the Trace Event Format (Google,
// 2016), which chrome://tracing and Perfetto read.
#pragma once

#include <filesystem>
#include <fstream>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {

class TraceFile {
 public:
  /// Replaces an old file. Errors: it cannot be written.
  static Result<TraceFile> create(const std::filesystem::path& path);

  /// Writes into two rows: the frame, from its first dispatch to the end of its last, and its dispatches.
  /// Frames count from 1.
  void addFrame(int number, std::span<const StageSpan> stages);
  /// Ends the file. Both programs also read a file that was not ended.
  Status finish();

 private:
  explicit TraceFile(std::filesystem::path path) : path_(std::move(path)), file_(path_) {}

  std::filesystem::path path_;
  std::ofstream file_;
};

}  // namespace ringlet
