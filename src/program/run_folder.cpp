// Implements run_folder.h.
#include "program/run_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <system_error>
#include <utility>

#include "ringlet/output/animation_writer.h"

namespace ringlet::program {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCheckpoint = "checkpoint.rgk";

// The temporary of a file that is written at once (base/whole_file.h): "last.obj.18a3-0.partial".
bool isTemporary(const fs::path& path) {
  const std::string name = path.filename().string();
  return path.extension() == ".partial" && name != "hair.usda.partial" &&
         std::ranges::any_of(std::to_array({"checkpoint.rgk.", "last.obj.", "sheet.png.", "hair.usda."}),
                             [&](const char* of) { return name.starts_with(of); });
}

}  // namespace

Result<RunFolder> RunFolder::open(const fs::path& folder, Leftovers leftovers) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code)
    return Error{fmt::format("cannot create the folder {}: {}", folder.string(), code.message()),
                 Fault::output};
  // mpirun does not wait for the ranks that it kills, and a script that starts again is quick.
  constexpr std::chrono::seconds kPatience(3);
  auto lock = FolderLock::take(folder, "ringlet simulate", kPatience);
  if (!lock) return lock.error();
  RunFolder made(folder, std::move(*lock));
  if (Status read = made.readLeftovers(leftovers); !read) return read.error();
  return made;
}

std::vector<std::string> RunFolder::leftBehind() const {
  std::vector<std::string> left;
  std::error_code code;
  std::vector<std::string> names{kCheckpoint};
  for (const AnimationFormat& format : animationFormats())
    names.push_back(fmt::format("hair{}.partial", format.extension));
  for (const std::string& name : names) {
    if (fs::exists(fs::symlink_status(folder_ / name, code))) left.push_back(name);
  }
  return left;
}

Status RunFolder::readLeftovers(Leftovers leftovers) {
  if (!lock_.deadOwner().empty())
    warnings_.push_back(fmt::format(
        "{} had this folder and ended without giving it back; this run takes it over", lock_.deadOwner()));
  const std::vector<std::string> left = leftBehind();
  const bool hasCheckpoint = std::ranges::find(left, kCheckpoint) != left.end();
  if (leftovers == Leftovers::refuse && !left.empty()) {
    return Error{
        fmt::format("{} holds what a run left that did not end: {}. {}--overwrite begins anew; `ringlet "
                    "convert` takes frames out of a .partial",
                    folder_.string(), fmt::join(left, ", "),
                    hasCheckpoint ? "--resume goes on with it; " : ""),
        Fault::output};
  }
  if (leftovers == Leftovers::resume) {
    if (!hasCheckpoint && !left.empty()) {
      return Error{fmt::format("{} holds {} and no checkpoint to go on from; --overwrite begins anew",
                               folder_.string(), fmt::join(left, ", ")),
                   Fault::output};
    }
    if (hasCheckpoint) {
      auto checkpoint = readCheckpoint(checkpointPath());
      if (!checkpoint) return checkpoint.error();
      checkpoint_ = std::move(*checkpoint);
    } else {
      warnings_.push_back(
          fmt::format("{} has nothing to go on with; the run begins at its first frame", folder_.string()));
    }
  }
  if (leftovers == Leftovers::refuse) return {};
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, ignored)) {
    if (isTemporary(entry.path())) fs::remove(entry.path(), ignored);
  }
  // Of the run that begins anew nothing may be taken for its own. Its frames stay until there is one to
  // replace them.
  if (leftovers == Leftovers::overwrite) fs::remove(checkpointPath(), ignored);
  return {};
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

Status checkInputsStay(const std::vector<fs::path>& inputs, const std::vector<fs::path>& outputs) {
  for (const fs::path& input : inputs) {
    for (const fs::path& output : outputs) {
      std::error_code code;
      if (!fs::equivalent(input, output, code) || code) continue;
      return Error{
          fmt::format("{} is read by this run and would be overwritten by it; choose another folder with -o",
                      input.string()),
          Fault::output};
    }
  }
  return {};
}

}  // namespace ringlet::program
