// RunCheckpoints: when a run writes checkpoints, and the facts that a run which resumes one must share.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/output/checkpoint_file.h"
#include "ringlet/run/run_folder.h"

namespace ringlet {

class RunCheckpoints {
 public:
  /// Without checkpoints: there is no folder, or the options ask for none and there is none to resume.
  RunCheckpoints() = default;
  /// `asked`: all facts that the run depends on, except those of its device. Fails where they differ from
  /// those in the folder's checkpoint.
  static Result<RunCheckpoints> make(const RunFolder& folder, int everyFrames, std::vector<RunFact> asked,
                                     const RunWords& words);
  /// Adds the facts of the device, which are known once kernels are compiled. Fails in the same way.
  Status addDevice(const RunFolder& folder, std::string device, std::string driver, std::string kernel);

  bool areWanted() const { return every_ > 0; }
  bool areDueAt(int frame) const { return every_ > 0 && frame % every_ == 0; }
  /// Replaces the folder's checkpoint.
  Status write(int frame, std::vector<std::byte> computed, std::vector<std::byte> written) const;

 private:
  std::filesystem::path path_;
  int every_ = 0;
  std::vector<RunFact> facts_;
  std::string overwrite_;  // how the user asks to overwrite
};

}  // namespace ringlet
