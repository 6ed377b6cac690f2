// BoxPairs: which boxes of a set overlap, in time proportional to boxes and overlaps. A grid of cells for
// every size of box, each half the size of the one before, so that a few large boxes do not make all cells
// large:
//
//   grid 0  |       .       |               |     a box is in the grid whose cells it just fits into, in the
//   grid 1  |   .   |   .   |       |       |     cell of its centre; what it overlaps in its own grid or a
//   grid 2  | . | . |   | . |   |   |   |   |     coarser one is then in that cell or one beside it
#pragma once

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

/// Boxes may be anywhere, of any size, empty, or in one place. A box that is not finite overlaps no other.
class BoxPairs {
 public:
  /// Copies the data it needs. Cost: linear.
  explicit BoxPairs(std::span<const Box> boxes);

  /// Calls visit(j) for boxes j != i that box i overlaps, always in the same order. Over all i every
  /// overlapping pair is met once, from either end. Boxes that all but touch count as overlapping.
  template <class Visit>
  void visitPartners(std::size_t i, Visit&& visit) const {
    visitCompared(i, [&](const Entry& entry) {
      if (overlap(boxes_[i], entry.bounds)) visit(static_cast<std::size_t>(entry.box));
    });
  }

  /// How many boxes visitPartners(i) compares with box i: the work it does.
  std::size_t comparedCount(std::size_t i) const {
    std::size_t count = 0;
    visitCompared(i, [&](const Entry&) { ++count; });
    return count;
  }

 private:
  struct Cell {
    std::int32_t x, y, z;
    bool operator==(const Cell&) const = default;
  };
  struct Entry {
    Box bounds;
    std::uint32_t box;
  };
  // Where the entries of a cell are; a cell without any is in no slot.
  struct Slot {
    Cell cell{};
    std::uint32_t firstEntry = 0, entryCount = 0;
  };
  // One size of boxes: a hash table of its cells, and its boxes cell by cell, by index within a cell.
  struct Grid {
    double cellSize = 1;
    std::uint32_t level = 0;  // 0 holds the largest boxes
    std::vector<Slot> slots;  // a power of two, at most half of them used
    std::vector<Entry> entries;

    Slot& slotOf(Cell cell) { return slots[slotIndex(cell)]; }
    const Slot& slotOf(Cell cell) const { return slots[slotIndex(cell)]; }

   private:
    // Teschner et al., "Optimized spatial hashing for collision detection of deformable objects", 2003; the
    // next free slot where cells share one.
    std::size_t slotIndex(Cell cell) const {
      const auto mixed = static_cast<std::uint32_t>(cell.x) * 73856093u ^
                         static_cast<std::uint32_t>(cell.y) * 19349663u ^
                         static_cast<std::uint32_t>(cell.z) * 83492791u;
      std::size_t slot = (mixed ^ mixed >> 16) & (slots.size() - 1);
      while (slots[slot].entryCount > 0 && slots[slot].cell != cell) slot = (slot + 1) & (slots.size() - 1);
      return slot;
    }
  };

  static bool overlap(const Box& a, const Box& b) {
    // A little generous: a caller's own test of the pair must not be beaten by rounding here.
    const Vec3d gap = a.centre - b.centre, reach = (a.halfSize + b.halfSize) * (1 + 1e-12);
    // All three comparisons at once: most boxes do not overlap, and a branch would be mispredicted often.
    const int inX = std::abs(gap.x) <= reach.x, inY = std::abs(gap.y) <= reach.y,
              inZ = std::abs(gap.z) <= reach.z;
    return (inX & inY & inZ) != 0;
  }
  Cell cellOf(Vec3d p, double cellSize) const {
    return {static_cast<std::int32_t>((p.x - low_.x) / cellSize),
            static_cast<std::int32_t>((p.y - low_.y) / cellSize),
            static_cast<std::int32_t>((p.z - low_.z) / cellSize)};
  }
  void fill(Grid& grid, std::span<const Box> boxes) const;
  // Calls compare(entry) for the boxes that may overlap box i and are its to look at.
  template <class Compare>
  void visitCompared(std::size_t i, Compare&& compare) const;

  static constexpr std::uint32_t kNoLevel = ~0u;  // of a box that is not finite

  Vec3d low_{};                        // least coordinates of all centres
  std::vector<Box> boxes_;             // as given
  std::vector<std::uint32_t> levels_;  // of each box
  std::vector<Grid> grids_;            // those that hold boxes, coarse to fine
};

template <class Compare>
void BoxPairs::visitCompared(std::size_t i, Compare&& compare) const {
  const Box& box = boxes_[i];
  for (const Grid& grid : grids_) {
    if (levels_[i] == kNoLevel || grid.level > levels_[i]) break;  // finer boxes look up this one
    const Cell centre = cellOf(box.centre, grid.cellSize);
    const bool own = grid.level == levels_[i];
    // Within a grid each pair of cells is visited from one side only: 13 of the 26 neighbours, and the cell
    // itself.
    for (int around = own ? 13 : 0; around < 27; ++around) {
      const Slot& slot =
          grid.slotOf({centre.x + around / 9 - 1, centre.y + around / 3 % 3 - 1, centre.z + around % 3 - 1});
      const bool itself = own && around == 13;
      for (std::uint32_t e = slot.firstEntry; e < slot.firstEntry + slot.entryCount; ++e) {
        const Entry& entry = grid.entries[e];
        if (itself && entry.box <= i) continue;
        compare(entry);
      }
    }
  }
}

}  // namespace ringlet
