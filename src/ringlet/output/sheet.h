// Sheet: a first look at a run. Six frames side by side in one picture, strands drawn as shaded lines. It
// shows what numbers do not: tangles, uncurled strands, hair where no hair should be.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/archive.h"
#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/output/picture.h"
#include "ringlet/output/up_axis.h"

namespace ringlet {

inline constexpr int kSheetPanels = 6;
inline constexpr int kPanelWidth = 480, kPanelHeight = 640;  // [pixel]

/// The frames a sheet shows of a run of `frameCount`: at most six, evenly chosen, the first and the last
/// among them.
std::vector<int> sheetFrames(int frameCount);

/// Hair as a panel of a picture.
struct Panel {
  std::span<const std::uint32_t> firstPoint;  // as in Groom
  std::span<const Vec3f> points;              // finite; none: an empty panel
  std::vector<std::string> labels{};          // a line each, below; letters are drawn as capitals
};

/// Panels row by row, each of `width` x `height` [pixel]. One camera looks at all of them, as Sheet says;
/// points are of one unit.
struct PanelGrid {
  int columns = kSheetPanels, rows = 1;
  int width = kPanelWidth, height = kPanelHeight;
  UpAxis up = UpAxis::y;
  int labelDot = 3;  // size of a letter's dot [pixel]
  int footer = 0;    // of each panel, that hair leaves free for labels [pixel]
};

/// At least one panel has points, and no more panels than places. A processor draws about a million edges a
/// second, and panels are drawn in parallel.
Picture drawPanels(std::span<const Panel> panels, const PanelGrid& grid);

/// One camera looks at all frames, from the front, a little from the side and from above, so that the whole
/// motion fits. Where hair travels so far that it would be tiny, the camera goes along with it.
class Sheet {
 public:
  /// Only the groom's strand lengths are used. `frameCount` is the number of frames planned.
  Sheet(const Groom& topology, int frameCount, UpAxis up);

  /// Hand in every frame, in order (1 is the first): the sheet keeps what it shows, and the latest, in case
  /// it is the last. Points in groom order, any unit, finite (see finite_points.h).
  void offer(int frame, std::span<const Vec3f> points);

  /// The frames it keeps, for a checkpoint.
  void archive(Archive& archive);

  /// Draws the frames it has, at least one.
  Picture draw() const;
  Status write(const std::filesystem::path& path) const { return draw().writePng(path); }

 private:
  struct Frame {
    int number = 0;
    std::vector<Vec3f> points;
  };
  std::vector<std::uint32_t> firstPoint_;  // as in Groom
  std::vector<int> wanted_;
  UpAxis up_;
  std::vector<Frame> frames_;  // in order
};

}  // namespace ringlet
