// RunFolder: the folder that a run writes its results into, and has for itself. What a run leaves there that
// was killed (hair.usda.partial, hair.rgc.partial, checkpoint.rgk) is never touched without being asked to.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/output/checkpoint_file.h"
#include "ringlet/output/folder_lock.h"

namespace ringlet::program {

/// What becomes of a run that did not end.
enum class Leftovers { refuse, overwrite, resume };

class RunFolder {
 public:
  /// Makes the folder and takes it. Errors: it cannot be written; another run has it; it holds what another
  /// run left, and `leftovers` says to refuse; there is something to go on with, but no checkpoint that can
  /// be read.
  static Result<RunFolder> open(const std::filesystem::path& folder, Leftovers leftovers);

  /// To go on from; none where the run begins.
  const std::optional<Checkpoint>& checkpoint() const { return checkpoint_; }
  /// Its state is large, and no longer needed once it is restored.
  void dropState();
  std::filesystem::path checkpointPath() const { return folder_ / "checkpoint.rgk"; }
  /// The run is finished: nothing is left to go on from.
  void finish() const;

  /// Things the user should know of.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  RunFolder(std::filesystem::path folder, FolderLock lock)
      : folder_(std::move(folder)), lock_(std::move(lock)) {}
  std::vector<std::string> leftBehind() const;
  Status readLeftovers(Leftovers leftovers);

  std::filesystem::path folder_;
  FolderLock lock_;
  std::optional<Checkpoint> checkpoint_;
  std::vector<std::string> warnings_;
};

/// Fails where one of `inputs` is a file that the run would write: `simulate out/last.obj -o out`.
Status checkInputsStay(const std::vector<std::filesystem::path>& inputs,
                       const std::vector<std::filesystem::path>& outputs);

}  // namespace ringlet::program
