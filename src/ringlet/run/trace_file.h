// TraceFile: when each dispatch of a run's frames ran on the device, in the Trace Event Format (Google,
// 2016), which chrome://tracing and Perfetto show.
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
  /// An old file is replaced. Errors: it cannot be written.
  static Result<TraceFile> create(const std::filesystem::path& path);

  /// Two rows: frames, each from its first dispatch to the end of its last, and dispatches. 1 is the first
  /// frame.
  void addFrame(int number, std::span<const StageSpan> stages);
  /// Ends the file. A file that is not ended is read by both programs, too.
  Status finish();

 private:
  explicit TraceFile(std::filesystem::path path) : path_(std::move(path)), file_(path_) {}

  std::filesystem::path path_;
  std::ofstream file_;
};

}  // namespace ringlet
