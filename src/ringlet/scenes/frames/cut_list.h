// CutList: where strands of an animation are cut, and from which frame on. Files of animations keep the
// groom's strands whole, so that this stands beside them, as NAME.cuts.csv.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/scenes/frames/scene_frames.h"

namespace ringlet {

/// From this frame on, 1 being the first, no edge goes from the last of the `keep` points to the next.
struct FrameCut {
  int frame = 1;
  StrandCut cut;
};

class CutList {
 public:
  CutList() = default;
  /// Of a run of so many frames; what its pre-roll cuts is cut from the first on.
  CutList(const SceneFrames& frames, int frameCount);
  explicit CutList(std::vector<FrameCut> cuts) : cuts_(std::move(cuts)) {}

  /// What stands beside the animation; none where there is no such file. Errors: a file that is none.
  static Result<CutList> beside(const std::filesystem::path& animation);
  /// Beside the animation; without cuts, a list that is there is removed.
  Status write(const std::filesystem::path& animation) const;
  /// Of an animation that begins with a later frame of this one.
  CutList from(int firstFrame) const;

  const std::vector<FrameCut>& all() const { return cuts_; }
  /// By strand, rising, the first points of its pieces, whenever they are cut off.
  std::map<std::uint32_t, std::vector<std::uint32_t>> pieces() const;
  /// Rising, among all points, those from which no edge goes on in a frame. `firstPoint`: of each strand, and
  /// one more. Cuts of strands that there are not, or at their ends, count for nothing.
  std::vector<std::uint32_t> cutBeyond(int frame, std::span<const std::uint32_t> firstPoint) const;

 private:
  std::vector<FrameCut> cuts_;
};

}  // namespace ringlet
