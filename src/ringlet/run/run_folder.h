// RunFolder: the folder that a run writes its results into, locked for that run. Files that earlier runs
// left, finished (hair.usda, sheet.png) or killed (hair.usda.partial, checkpoint.rgk), are touched only on
// request.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/output/checkpoint_file.h"
#include "ringlet/output/folder_lock.h"
#include "ringlet/run/run_options.h"

namespace ringlet {

class RunFolder {
 public:
  /// Makes the folder and locks it for a run that will write `outputs`. Errors: it cannot be written; another
  /// run has it; it contains leftovers of another run or some of `outputs`, and `leftovers` does not say to
  /// overwrite; it is to be resumed, but has no readable checkpoint.
  static Result<RunFolder> open(const std::filesystem::path& folder, Leftovers leftovers,
                                const std::vector<std::filesystem::path>& outputs, const RunWords& words);

  /// The checkpoint to resume from; none if the run begins.
  const std::optional<Checkpoint>& checkpoint() const { return checkpoint_; }
  /// Frees the checkpoint's state, which is large, once it is restored.
  void dropState();
  std::filesystem::path checkpointPath() const { return folder_ / "checkpoint.rgk"; }
  /// Removes the checkpoint after the run has finished.
  void finish() const;

  /// Warnings for the user.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  RunFolder(std::filesystem::path folder, FolderLock lock)
      : folder_(std::move(folder)), lock_(std::move(lock)) {}
  Status readLeftovers(Leftovers leftovers, const std::vector<std::filesystem::path>& outputs,
                       const RunWords& words);
  void dropTemporaries() const;

  std::filesystem::path folder_;
  FolderLock lock_;
  std::optional<Checkpoint> checkpoint_;
  std::vector<std::string> warnings_;
};

/// Fails where `folder` contains leftovers of a run that did not end, or some of `outputs`, which are in it.
Status checkFolderIsFree(const std::filesystem::path& folder,
                         const std::vector<std::filesystem::path>& outputs, const RunWords& words);

/// Fails where one of `inputs` is a file that the run would write: `simulate out/last.obj -o out`.
Status checkInputsStay(const std::vector<std::filesystem::path>& inputs,
                       const std::vector<std::filesystem::path>& outputs, const RunWords& words);

}  // namespace ringlet
