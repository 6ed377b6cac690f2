// Implements run_folder.h.
#include "ringlet/run/run_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <system_error>
#include <utility>

#include "ringlet/base/whole_file.h"
#include "ringlet/output/animation_writer.h"

namespace ringlet {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCheckpoint = "checkpoint.rgk";

// Files that a run left which did not end.
std::vector<std::string> leftIn(const fs::path& folder) {
  std::vector<std::string> names{kCheckpoint}, left;
  for (const AnimationFormat& format : animationFormats())
    names.push_back(fmt::format("hair{}.partial", format.extension));
  std::error_code code;
  for (const std::string& name : names) {
    if (fs::exists(fs::symlink_status(folder / name, code))) left.push_back(name);
  }
  return left;
}

// Whether a run may have written a file of that name in one piece: the checkpoint, last.obj, sheet.png, and
// files beside an animation (hair.obj of hair.pc2, hair.usda.cuts.csv).
bool isOfARun(const std::string& name) {
  return name == kCheckpoint || name == "last.obj" || name == "sheet.png" || name.starts_with("hair.");
}

Error isFinished(const fs::path& folder, const std::vector<std::string>& finished, const RunWords& words) {
  return {fmt::format("{} holds a run's files: {}. {} replaces them; choose {} to keep them", folder.string(),
                      fmt::join(finished, ", "), words.overwrite, words.elsewhere),
          Fault::output};
}

std::vector<std::string> finishedOf(const std::vector<fs::path>& outputs) {
  std::vector<std::string> finished;
  std::error_code code;
  for (const fs::path& output : outputs) {
    if (fs::exists(fs::symlink_status(output, code))) finished.push_back(output.filename().string());
  }
  return finished;
}

Error isLeft(const fs::path& folder, const std::vector<std::string>& left, const RunWords& words) {
  const bool hasCheckpoint = std::ranges::find(left, kCheckpoint) != left.end();
  return {
      fmt::format("{} holds what a run left that did not end: {}. {}{} begins anew; `ringlet convert` takes "
                  "frames out of a .partial",
                  folder.string(), fmt::join(left, ", "),
                  hasCheckpoint ? words.resume + " goes on with it; " : "", words.overwrite),
      Fault::output};
}

}  // namespace

Result<RunFolder> RunFolder::open(const fs::path& folder, Leftovers leftovers,
                                  const std::vector<fs::path>& outputs, const RunWords& words) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code)
    return Error{fmt::format("cannot create the folder {}: {}", folder.string(), code.message()),
                 Fault::output};
  // mpirun does not wait for ranks that it kills, and a script may start the next run at once.
  constexpr std::chrono::seconds kPatience(3);
  auto lock = FolderLock::take(folder, words.who, kPatience);
  if (!lock) return lock.error();
  RunFolder made(folder, std::move(*lock));
  if (Status read = made.readLeftovers(leftovers, outputs, words); !read) return read.error();
  return made;
}

Status RunFolder::readLeftovers(Leftovers leftovers, const std::vector<fs::path>& outputs,
                                const RunWords& words) {
  if (!lock_.deadOwner().empty())
    warnings_.push_back(fmt::format(
        "{} had this folder and ended without giving it back; this run takes it over", lock_.deadOwner()));
  if (leftovers == Leftovers::refuse) return checkFolderIsFree(folder_, outputs, words);
  const std::vector<std::string> left = leftIn(folder_);
  const bool hasCheckpoint = std::ranges::find(left, kCheckpoint) != left.end();
  if (leftovers != Leftovers::overwrite && hasCheckpoint) {
    auto checkpoint = readCheckpoint(checkpointPath());
    if (!checkpoint) return checkpoint.error();
    checkpoint_ = std::move(*checkpoint);
  }
  if (leftovers == Leftovers::resume && !hasCheckpoint) {
    if (!left.empty()) {
      return Error{fmt::format("{} holds {} and no checkpoint to go on from; {} begins anew",
                               folder_.string(), fmt::join(left, ", "), words.overwrite),
                   Fault::output};
    }
    if (const auto finished = finishedOf(outputs); !finished.empty())
      return isFinished(folder_, finished, words);
  }
  if (leftovers != Leftovers::overwrite && !hasCheckpoint)
    warnings_.push_back(
        fmt::format("{} has nothing to go on with; the run begins at its first frame", folder_.string()));
  dropTemporaries();
  // A run that begins anew must not take the checkpoint of an old one for its own. Old frames stay until
  // there is a frame to replace them.
  std::error_code ignored;
  if (!checkpoint_) fs::remove(checkpointPath(), ignored);
  return {};
}

// Removes temporary files that a killed run left.
void RunFolder::dropTemporaries() const {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, ignored)) {
    const auto of = fileOfTemporary(entry.path());
    if (of && isOfARun(of->filename().string())) fs::remove(entry.path(), ignored);
  }
}

void RunFolder::dropState() {
  if (!checkpoint_) return;
  checkpoint_->computed = {};
  checkpoint_->written = {};
}

void RunFolder::finish() const {
  std::error_code ignored;
  fs::remove(checkpointPath(), ignored);
}

Status checkFolderIsFree(const fs::path& folder, const std::vector<fs::path>& outputs,
                         const RunWords& words) {
  if (const auto left = leftIn(folder); !left.empty()) return isLeft(folder, left, words);
  if (const auto finished = finishedOf(outputs); !finished.empty())
    return isFinished(folder, finished, words);
  return {};
}

Status checkInputsStay(const std::vector<fs::path>& inputs, const std::vector<fs::path>& outputs,
                       const RunWords& words) {
  for (const fs::path& input : inputs) {
    for (const fs::path& output : outputs) {
      std::error_code code;
      if (!fs::equivalent(input, output, code) || code) continue;
      return Error{fmt::format("{} is read by this run and would be overwritten by it; choose {}",
                               input.string(), words.elsewhere),
                   Fault::output};
    }
  }
  return {};
}

}  // namespace ringlet
