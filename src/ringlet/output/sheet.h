// Sheet: a first look at a run. Six frames side by side in one picture, strands drawn as shaded lines. It
// shows faults that numbers do not: tangles, uncurled strands, hair in wrong places.
#pragma once

#include <array>
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

/// What hair is drawn with: triangles, counter-clockwise seen from outside, in a frame of its own [m].
struct SheetSolid {
  std::vector<Vec3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices of points; shared points shade smoothly
};

/// World from solid.
struct SheetPlace {
  Vec3d position;  // [m]
  Quatd rotation;
};

/// Hair as a panel of a picture.
struct Panel {
  std::span<const std::uint32_t> firstPoint;  // as in Groom
  std::span<const Vec3f> points;              // finite; none: an empty panel
  std::vector<std::string> labels{};          // a line each, below; letters are drawn as capitals
  std::span<const SheetSolid> solids{};
  std::span<const SheetPlace> places{};        // of each solid
  double metresPerUnit = 1;                    // of points, for the solids
  std::span<const std::uint32_t> cutBeyond{};  // rising: points from which no edge goes on
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
/// motion of the hair fits, and of solids what is near it. Where hair travels so far that it would be tiny,
/// the camera goes along with it.
class Sheet {
 public:
  /// Only the groom's strand lengths and unit are used. `frameCount` is the number of frames planned.
  Sheet(const Groom& topology, int frameCount, UpAxis up, std::vector<SheetSolid> solids = {});

  /// Hand in every frame, in order (1 is the first): the sheet keeps what it shows, and the latest, in case
  /// it is the last. Points in groom order and unit, finite (see finite_points.h); a place for each solid;
  /// `cutBeyond` as in Panel.
  void offer(int frame, std::span<const Vec3f> points, std::span<const SheetPlace> places = {},
             std::span<const std::uint32_t> cutBeyond = {});

  /// The frames it keeps, for a checkpoint.
  void archive(Archive& archive);

  /// Draws the frames it has, at least one.
  Picture draw() const;
  Status write(const std::filesystem::path& path) const { return draw().writePng(path); }

 private:
  struct Frame {
    int number = 0;
    std::vector<Vec3f> points;
    std::vector<SheetPlace> places;
    std::vector<std::uint32_t> cutBeyond;
  };
  std::vector<std::uint32_t> firstPoint_;  // as in Groom
  double metresPerUnit_;
  std::vector<SheetSolid> solids_;
  std::vector<int> wanted_;
  UpAxis up_;
  std::vector<Frame> frames_;  // in order
};

}  // namespace ringlet
