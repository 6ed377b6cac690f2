// Implements run_checkpoints.h.
#include "program/run_checkpoints.h"

#include <fmt/format.h>

namespace ringlet::program {
namespace {

bool isOfDevice(const RunFact& fact) {
  return fact.name == "device" || fact.name == "driver" || fact.name == "kernel";
}

// Those of `before` that are of the device, or those that are not, against the same of this run.
Status compare(const std::filesystem::path& path, const std::vector<RunFact>& now,
               std::vector<RunFact> before, bool ofDevice) {
  std::erase_if(before, [&](const RunFact& fact) { return isOfDevice(fact) != ofDevice; });
  const std::string differences = differencesOf(now, before);
  if (differences.empty()) return {};
  return Error{fmt::format("{} is of another run: {}. Ask for the same, or begin anew with --overwrite",
                           path.string(), differences),
               Fault::input};
}

}  // namespace

Result<RunCheckpoints> RunCheckpoints::make(const RunFolder& folder, int everyFrames,
                                            std::vector<RunFact> asked) {
  RunCheckpoints made;
  made.path_ = folder.checkpointPath();
  made.every_ = everyFrames;
  made.facts_ = std::move(asked);
  const std::optional<Checkpoint>& before = folder.checkpoint();
  if (!before) return made;
  if (made.every_ == 0) made.every_ = before->everyFrames;
  if (Status same = compare(made.path_, made.facts_, before->facts, false); !same) return same.error();
  return made;
}

Status RunCheckpoints::addDevice(const RunFolder& folder, std::string device, std::string driver,
                                 std::string kernel) {
  const std::vector<RunFact> facts{
      {"device", std::move(device)}, {"driver", std::move(driver)}, {"kernel", std::move(kernel)}};
  facts_.insert(facts_.end(), facts.begin(), facts.end());
  return folder.checkpoint() ? compare(path_, facts, folder.checkpoint()->facts, true) : Status();
}

Status RunCheckpoints::write(int frame, std::vector<std::byte> computed,
                             std::vector<std::byte> written) const {
  return writeCheckpoint(path_, {facts_, every_, frame, std::move(computed), std::move(written)});
}

}  // namespace ringlet::program
