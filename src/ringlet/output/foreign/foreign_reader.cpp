// Implements output/foreign/foreign_reader.h.
#include "ringlet/output/foreign/foreign_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "ringlet/groom/root_ends.h"
#include "ringlet/output/frame_reader.h"

namespace ringlet {
namespace {

// What the file says of strands at their roots; nothing where it says none that is above 0.
std::optional<float> rootWidthOf(const LoadedGroom& loaded) {
  for (const GroomPrim& prim : loaded.prims)
    for (const GroomValue& value : prim.values)
      if (value.name == "widths" && !value.numbers.empty()) {
        const auto width = static_cast<float>(value.numbers.front());
        if (width > 0 && std::isfinite(width)) return width;
      }
  return std::nullopt;
}

std::vector<bool> strandsToTurn(RootEnd end, const Groom& groom) {
  if (end == RootEnd::first) return {};
  if (end == RootEnd::last) return std::vector<bool>(groom.strandCount(), true);
  return findRootEnds(groom).isReversed;
}

}  // namespace

Result<ForeignReader> ForeignReader::open(const std::filesystem::path& path, const ForeignReading& reading) {
  try {
    auto frames = openForeignFrames(path, reading);
    if (!frames) return frames.error();
    ForeignReader self;
    self.path_ = path;
    self.frames_ = std::move(*frames);
    if (Status taken = self.takeFirst(reading); !taken) return taken.error();
    return self;
  } catch (const std::bad_alloc&) {
    return Error{fmt::format("{}: reading it needs more memory than there is", path.string())};
  }
}

Status ForeignReader::takeFirst(const ForeignReading& reading) {
  reading_ = {.upIsZ = reading.upIsZ.value_or(false), .pointsPerStrand = reading.pointsPerStrand};
  auto first = frameOf(1, reading_);
  if (!first) return first.error();
  if (!reading.upIsZ && first->isTurned) {
    reading_.upIsZ = true;
    first = frameOf(1, reading_);
    if (!first) return first.error();
  }
  isTurned_ = strandsToTurn(reading.rootEnd, first->groom);
  firstPoint_ = first->groom.firstPoint;
  statesUnit_ = first->statesUnit || reading.metresPerUnit;
  metresPerUnit_ = reading.metresPerUnit.value_or(first->groom.metresPerUnit);
  // Its values once more, without what is odd about them: of these only the widths count.
  const auto withWidths =
      frameOf(1, {.upIsZ = reading_.upIsZ, .keepsPrims = true, .pointsPerStrand = reading.pointsPerStrand});
  if (!withWidths) return withWidths.error();
  diameter_ = rootWidthOf(*withWidths).value_or(static_cast<float>(kUsualWidth / metresPerUnit_));
  warnings_ = std::move(first->warnings);
  warnings_.insert(warnings_.end(), frames_->warnings().begin(), frames_->warnings().end());
  return {};
}

Result<LoadedGroom> ForeignReader::frameOf(int frame, const GroomReading& reading) {
  try {
    return frames_->frame(frame, reading);
  } catch (const std::bad_alloc&) {
    return Error{fmt::format("{}: frame {} needs more memory than there is", path_.string(), frame)};
  }
}

Status ForeignReader::readFrame(int frame, std::vector<Vec3f>& points) {
  auto read = frameOf(frame, reading_);
  if (!read) return Error{fmt::format("frame {}: {}", frame, read.error().message), read.error().fault};
  Groom& groom = read->groom;
  if (groom.firstPoint != firstPoint_)
    return Error{fmt::format(
        "{}: frame {} has {} strands of {} points in all, and frame 1 {} of {}; expected the same strands, "
        "point for point",
        path_.string(), frame, groom.strandCount(), groom.points.size(), firstPoint_.size() - 1,
        firstPoint_.back())};
  if (!isTurned_.empty()) turnRound(isTurned_, groom);
  points = std::move(groom.points);
  return {};
}

}  // namespace ringlet
