// BoxPairs: which boxes of a set overlap, in time proportional to boxes and overlaps. A grid of cells for
// every size of box, each half the size of the one before, so that a few large boxes do not make all cells
// large:
//
//   grid 0  |       .       |               |     a box is in the grid whose cells it just fits into, in the
//   grid 1  |   .   |   .   |       |       |     cell of its centre; what it overlaps in its own grid or a
//   grid 2  | . | . |   | . |   |   |   |   |     coarser one is then in that cell or one beside it
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// Parallel to the axes.
struct Box {
  Vec3d centre, halfSize;
};

/// Boxes may be anywhere, of any size, empty, or in one place. Those that are not finite overlap nothing.
class BoxPairs {
 public:
  /// Keeps what it needs. Cost: linear.
  explicit BoxPairs(std::span<const Box> boxes);

  /// Calls visit(j) for boxes j != i that box i overlaps, always in the same order. Over all i every
  /// overlapping pair is met once, from either end. Boxes that all but touch count as overlapping.
  template <class Visit>
  void visitPartners(std::size_t i, Visit&& visit) const;

 private:
  using Cell = std::array<std::int32_t, 3>;
  struct Entry {
    Cell cell;
    std::uint32_t box;
    Box bounds;
  };
  // One size of boxes: its entries by hash of their cell, and by index within one hash.
  struct Grid {
    double cellSize = 1;
    std::uint32_t level = 0;                // 0 holds the largest boxes
    std::vector<std::uint32_t> firstEntry;  // of each hash, and an end; hashes are a power of two in number
    std::vector<Entry> entries;
  };

  static std::size_t hashOf(Cell cell) {
    // Teschner et al., "Optimized spatial hashing for collision detection of deformable objects", 2003.
    const auto mixed = static_cast<std::uint32_t>(cell[0]) * 73856093u ^
                       static_cast<std::uint32_t>(cell[1]) * 19349663u ^
                       static_cast<std::uint32_t>(cell[2]) * 83492791u;
    return mixed ^ mixed >> 16;
  }
  static bool overlap(const Box& a, const Box& b) {
    // A little generous: a caller's own test of the pair must not be beaten by rounding here.
    const Vec3d gap = a.centre - b.centre, reach = (a.halfSize + b.halfSize) * (1 + 1e-12);
    return std::abs(gap.x) <= reach.x && std::abs(gap.y) <= reach.y && std::abs(gap.z) <= reach.z;
  }
  Cell cellOf(Vec3d p, double cellSize) const {
    return {static_cast<std::int32_t>((p.x - low_.x) / cellSize),
            static_cast<std::int32_t>((p.y - low_.y) / cellSize),
            static_cast<std::int32_t>((p.z - low_.z) / cellSize)};
  }
  void fill(Grid& grid, std::span<const Box> boxes) const;

  static constexpr std::uint32_t kNoLevel = ~0u;  // of a box that is not finite

  Vec3d low_{};                        // least coordinates of all centres
  std::vector<Box> boxes_;             // as given
  std::vector<std::uint32_t> levels_;  // of each box
  std::vector<Grid> grids_;            // those that hold boxes, coarse to fine
};

template <class Visit>
void BoxPairs::visitPartners(std::size_t i, Visit&& visit) const {
  const Box& box = boxes_[i];
  for (const Grid& grid : grids_) {
    if (levels_[i] == kNoLevel || grid.level > levels_[i]) break;  // finer boxes look up this one
    const Cell centre = cellOf(box.centre, grid.cellSize);
    const bool own = grid.level == levels_[i];
    const std::size_t mask = grid.firstEntry.size() - 2;
    // Within a grid each pair of cells is looked at from one side only: 13 of the 26 beside, and itself.
    for (int around = own ? 13 : 0; around < 27; ++around) {
      const Cell cell{centre[0] + around / 9 - 1, centre[1] + around / 3 % 3 - 1, centre[2] + around % 3 - 1};
      const bool itself = own && around == 13;
      const std::size_t hash = hashOf(cell) & mask;
      for (std::uint32_t e = grid.firstEntry[hash]; e < grid.firstEntry[hash + 1]; ++e) {
        const Entry& entry = grid.entries[e];
        if (entry.cell != cell || (itself && entry.box <= i)) continue;
        if (overlap(box, entry.bounds)) visit(static_cast<std::size_t>(entry.box));
      }
    }
  }
}

}  // namespace ringlet
