// Implements cut_list.h.
#include "ringlet/scenes/frames/cut_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>

#include "ringlet/base/whole_file.h"

namespace ringlet {
namespace {

constexpr const char* kHead = "frame,strand,keep";

// Of an animation, finished or not.
std::filesystem::path listOf(std::filesystem::path animation) {
  if (animation.extension() == ".partial") animation.replace_extension();
  return animation += ".cuts.csv";
}

}  // namespace

CutList::CutList(const SceneFrames& frames, int frameCount) {
  for (int frame = frames.first(); frame < frameCount; ++frame) {
    for (const TimedCuts& now : frames.cutsAt(frame))
      for (const StrandCut& cut : now.cuts) cuts_.push_back({std::max(frame, 0) + 1, cut});
  }
}

Result<CutList> CutList::beside(const std::filesystem::path& animation) {
  const std::filesystem::path path = listOf(animation);
  std::error_code code;
  if (!std::filesystem::exists(path, code)) return CutList();
  std::ifstream file(path);
  const auto failed = [&](int line) {
    return Error{
        fmt::format(
            "cannot read line {} of {}: expected {}, as `ringlet simulate` writes it; delete the file if it "
            "is not of the animation beside it",
            line, path.string(), line == 1 ? kHead : "three whole numbers"),
        Fault::input};
  };
  std::string text;
  if (!std::getline(file, text) || text != kHead) return failed(1);
  std::vector<FrameCut> cuts;
  for (int line = 2; std::getline(file, text); ++line) {
    FrameCut cut;
    char comma[2] = {};
    std::istringstream values(text);
    values >> cut.frame >> comma[0] >> cut.cut.strand >> comma[1] >> cut.cut.keep;
    if (!values || comma[0] != ',' || comma[1] != ',' || !(values >> std::ws).eof()) return failed(line);
    cuts.push_back(cut);
  }
  return CutList(std::move(cuts));
}

Status CutList::write(const std::filesystem::path& animation) const {
  const std::filesystem::path path = listOf(animation);
  if (cuts_.empty()) {
    std::error_code code;
    std::filesystem::remove(path, code);
    if (code) return Error{fmt::format("cannot remove {}: {}", path.string(), code.message())};
    return {};
  }
  std::string text = fmt::format("{}\n", kHead);
  for (const FrameCut& each : cuts_)
    text += fmt::format("{},{},{}\n", each.frame, each.cut.strand, each.cut.keep);
  return writeWholeFile(path, std::as_bytes(std::span<const char>(text)));
}

CutList CutList::from(int firstFrame) const {
  CutList later = *this;
  for (FrameCut& each : later.cuts_) each.frame = std::max(each.frame - firstFrame + 1, 1);
  return later;
}

std::map<std::uint32_t, std::vector<std::uint32_t>> CutList::pieces() const {
  std::map<std::uint32_t, std::vector<std::uint32_t>> pieces;
  for (const FrameCut& each : cuts_) pieces[each.cut.strand].push_back(each.cut.keep);
  for (auto& [strand, first] : pieces) {
    std::ranges::sort(first);
    first.erase(std::unique(first.begin(), first.end()), first.end());
  }
  return pieces;
}

std::vector<std::uint32_t> CutList::cutBeyond(int frame, std::span<const std::uint32_t> firstPoint) const {
  std::vector<std::uint32_t> points;
  for (const auto& [at, cut] : cuts_) {
    if (at > frame || cut.strand + std::size_t{1} >= firstPoint.size() || cut.keep == 0) continue;
    if (cut.keep < firstPoint[cut.strand + 1] - firstPoint[cut.strand])
      points.push_back(firstPoint[cut.strand] + cut.keep - 1);
  }
  std::ranges::sort(points);
  return points;
}

}  // namespace ringlet
