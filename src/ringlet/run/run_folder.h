// RunFolder: the folder that a run writes its results into, and has for itself. What runs left there,
// finished (hair.usda, sheet.png) or killed (hair.usda.partial, checkpoint.rgk), is never touched without
// being asked to.
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
  /// Makes the folder and takes it for a run that will write `outputs`. Errors: it cannot be written; another
  /// run has it; it holds what another run left or some of `outputs`, and `leftovers` does not say to
  /// overwrite; there is something to go on with, but no checkpoint that can be read.
  static Result<RunFolder> open(const std::filesystem::path& folder, Leftovers leftovers,
                                const std::vector<std::filesystem::path>& outputs, const RunWords& words);

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
  Status readLeftovers(Leftovers leftovers, const std::vector<std::filesystem::path>& outputs,
                       const RunWords& words);
  void dropTemporaries() const;

  std::filesystem::path folder_;
  FolderLock lock_;
  std::optional<Checkpoint> checkpoint_;
  std::vector<std::string> warnings_;
};

/// Fails where `folder` holds what a run left that did not end, or some of `outputs`, which are in it.
Status checkFolderIsFree(const std::filesystem::path& folder,
                         const std::vector<std::filesystem::path>& outputs, const RunWords& words);

/// Fails where one of `inputs` is a file that the run would write: `simulate out/last.obj -o out`.
Status checkInputsStay(const std::vector<std::filesystem::path>& inputs,
                       const std::vector<std::filesystem::path>& outputs, const RunWords& words);

}  // namespace ringlet
