// Implements base/box_pairs.h.
#include "ringlet/base/box_pairs.h"

#include <algorithm>
#include <bit>

#include "ringlet/base/bounds.h"

namespace ringlet {
namespace {

// Cells are this much larger than the largest box in them: by more than rounding can move a centre over
// cells.
constexpr double kCellMargin = 1 + 1e-6;

// Cells along an axis, at most: their numbers fit into 32 bits, and rounding stays below the margin.
constexpr double kMostCells = 0x1p30;

double largest(Vec3d v) { return std::max({v.x, v.y, v.z}); }

}  // namespace

BoxPairs::BoxPairs(std::span<const Box> boxes)
    : boxes_(boxes.begin(), boxes.end()), levels_(boxes.size(), kNoLevel) {
  Bounds bounds = Bounds::none();
  double largestSize = 0;
  for (const Box& box : boxes) {
    if (!isFinite(box.centre) || !isFinite(box.halfSize)) continue;
    bounds.add(box.centre);
    largestSize = std::max(largestSize, 2 * largest(box.halfSize));
  }
  low_ = bounds.low;
  const double extent = std::max(0.0, largest(bounds.high - bounds.low));
  const double smallestCell = extent / kMostCells;
  double coarsest = std::max(largestSize * kCellMargin, smallestCell);
  if (!(coarsest > 0)) coarsest = 1;  // points in one place: any cell will do
  const std::uint32_t finestLevel =
      smallestCell > 0 ? static_cast<std::uint32_t>(std::min(40, std::ilogb(coarsest / smallestCell))) : 0;

  std::vector<std::size_t> countOfLevel(finestLevel + 1);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!isFinite(boxes[i].centre) || !isFinite(boxes[i].halfSize)) continue;
    const double size = 2 * largest(boxes[i].halfSize) * kCellMargin;
    levels_[i] =
        size * 0x1p40 > coarsest
            ? std::min(finestLevel, static_cast<std::uint32_t>(std::max(0, std::ilogb(coarsest / size))))
            : finestLevel;
    ++countOfLevel[levels_[i]];
  }
  for (std::uint32_t level = 0; level <= finestLevel; ++level) {
    if (countOfLevel[level] == 0) continue;
    Grid& grid = grids_.emplace_back();
    grid.level = level;
    grid.cellSize = std::ldexp(coarsest, -static_cast<int>(level));
    grid.slots.resize(2 * std::bit_ceil(countOfLevel[level]));
    fill(grid, boxes);
  }
}

// A counting sort by cell; cells lie in the order in which boxes first use them, which is near where boxes
// are.
void BoxPairs::fill(Grid& grid, std::span<const Box> boxes) const {
  std::vector<std::uint32_t> slotsInOrder;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (levels_[i] != grid.level) continue;
    const Cell cell = cellOf(boxes[i].centre, grid.cellSize);
    Slot& slot = grid.slotOf(cell);
    if (slot.entryCount++ > 0) continue;
    slot.cell = cell;
    slotsInOrder.push_back(static_cast<std::uint32_t>(&slot - grid.slots.data()));
  }
  std::vector<std::uint32_t> nextEntry(grid.slots.size());
  std::uint32_t firstEntry = 0;
  for (std::uint32_t s : slotsInOrder) {
    grid.slots[s].firstEntry = nextEntry[s] = firstEntry;
    firstEntry += grid.slots[s].entryCount;
  }
  grid.entries.resize(firstEntry);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (levels_[i] != grid.level) continue;
    const Slot& slot = grid.slotOf(cellOf(boxes[i].centre, grid.cellSize));
    grid.entries[nextEntry[static_cast<std::size_t>(&slot - grid.slots.data())]++] = {
        boxes[i], static_cast<std::uint32_t>(i)};
  }
}

}  // namespace ringlet
