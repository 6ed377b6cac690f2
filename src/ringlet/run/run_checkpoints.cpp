// Implements run_checkpoints.h.
#include "ringlet/run/run_checkpoints.h"

#include <fmt/format.h>

namespace ringlet {
namespace {

bool isOfDevice(const RunFact& fact) {
  return fact.name == "device" || fact.name == "driver" || fact.name == "kernel";
}

// Compares the facts about the device (ofDevice), or the other ones, of `before` with those of this run.
Status compare(const std::filesystem::path& path, const std::vector<RunFact>& now,
               std::vector<RunFact> before, bool ofDevice, const std::string& overwrite) {
  std::erase_if(before, [&](const RunFact& fact) { return isOfDevice(fact) != ofDevice; });
  const std::string differences = differencesOf(now, before);
  if (differences.empty()) return {};
  return Error{fmt::format("{} is of another run: {}. Ask for the same, or begin anew with {}", path.string(),
                           differences, overwrite),
               Fault::input};
}

}  // namespace

Result<RunCheckpoints> RunCheckpoints::make(const RunFolder& folder, int everyFrames,
                                            std::vector<RunFact> asked, const RunWords& words) {
  RunCheckpoints made;
  made.path_ = folder.checkpointPath();
  made.every_ = everyFrames;
  made.facts_ = std::move(asked);
  made.overwrite_ = words.overwrite;
  const std::optional<Checkpoint>& before = folder.checkpoint();
  if (!before) return made;
  if (made.every_ == 0) made.every_ = before->everyFrames;
  if (Status same = compare(made.path_, made.facts_, before->facts, false, words.overwrite); !same)
    return same.error();
  return made;
}

Status RunCheckpoints::addDevice(const RunFolder& folder, std::string device, std::string driver,
                                 std::string kernel) {
  const std::vector<RunFact> facts{
      {"device", std::move(device)}, {"driver", std::move(driver)}, {"kernel", std::move(kernel)}};
  facts_.insert(facts_.end(), facts.begin(), facts.end());
  return folder.checkpoint() ? compare(path_, facts, folder.checkpoint()->facts, true, overwrite_) : Status();
}

Status RunCheckpoints::write(int frame, std::vector<std::byte> computed,
                             std::vector<std::byte> written) const {
  return writeCheckpoint(path_, {facts_, every_, frame, std::move(computed), std::move(written)});
}

}  // namespace ringlet
