// RunCheckpoints: when a run writes what it could go on from, and what it was a run of.
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
  /// None: without a folder, or where the options ask for none and there is nothing to go on from.
  RunCheckpoints() = default;
  /// `asked`: all that the run depends on but its device. Fails where that differs from what the folder's
  /// checkpoint was asked.
  static Result<RunCheckpoints> make(const RunFolder& folder, int everyFrames, std::vector<RunFact> asked,
                                     const RunWords& words);
  /// The rest of what the run depends on, known once kernels are compiled. Fails in the same way.
  Status addDevice(const RunFolder& folder, std::string device, std::string driver, std::string kernel);

  bool areWanted() const { return every_ > 0; }
  bool areDueAt(int frame) const { return every_ > 0 && frame % every_ == 0; }
  /// Replaces the one there is.
  Status write(int frame, std::vector<std::byte> computed, std::vector<std::byte> written) const;

 private:
  std::filesystem::path path_;
  int every_ = 0;
  std::vector<RunFact> facts_;
  std::string overwrite_;  // how the user asks for it
};

}  // namespace ringlet
