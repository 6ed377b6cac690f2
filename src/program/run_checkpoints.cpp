// Implements run_checkpoints.h.
#include "program/run_checkpoints.h"

#include <fmt/format.h>

namespace ringlet::program {

Result<RunCheckpoints> RunCheckpoints::make(const RunFolder& folder, int everyFrames,
                                            std::vector<RunFact> facts) {
  RunCheckpoints made;
  made.path_ = folder.checkpointPath();
  made.every_ = everyFrames;
  made.facts_ = std::move(facts);
  const std::optional<Checkpoint>& before = folder.checkpoint();
  if (!before) return made;
  if (made.every_ == 0) made.every_ = before->everyFrames;
  if (const std::string differences = differencesOf(made.facts_, before->facts); !differences.empty()) {
    return Error{fmt::format("{} is of another run: {}. Ask for the same, or begin anew with --overwrite",
                             made.path_.string(), differences),
                 Fault::input};
  }
  return made;
}

Status RunCheckpoints::write(int frame, std::vector<std::byte> computed,
                             std::vector<std::byte> written) const {
  return writeCheckpoint(path_, {facts_, every_, frame, std::move(computed), std::move(written)});
}

}  // namespace ringlet::program
