// SphereCells: spheres sorted by the cells of a grid, and a sweep over them that finds overlaps.
//
//     row of cells (x-1, y)   . . . [o o o] . .
//     row of cells (x,   y)   . . . [o c o] . .
//     row of cells (x+1, y)   . . . [o o o] . .
//
// A cell's spheres reach into the cells around it: nine rows of three cells, each consecutive in the sorted
// order. As the sweep goes on to the next cell, all nine ranges only move forward. So memory is read in order
// and nothing is looked up: on large grooms look-ups miss every cache and took most of the time.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/vec3.h"

namespace ringlet {

struct Sphere {
  Vec3f centre;
  float radius;
  std::uint32_t strand;
};

class SphereCells {
 public:
  struct Cell {
    std::int32_t x, y, z;
    auto operator<=>(const Cell&) const = default;
  };

  /// Cells have size `cellSize`; `low` is below every sphere.
  SphereCells(std::span<const Sphere> spheres, Vec3d low, double cellSize);

  std::size_t cellCount() const { return cells_.size(); }

  /// Calls tell(sphere, other) for each sphere in the cells [begin, end) and each of `others` (in a grid of
  /// the same cells) in the same cell or beside it. Within one SphereCells a pair is told once, and no sphere
  /// is paired with itself.
  template <class Tell>
  void eachNear(const SphereCells& others, std::size_t begin, std::size_t end, const Tell& tell) const;

 private:
  std::vector<Sphere> spheres_;
  std::vector<Cell> cells_;           // those with spheres, ascending
  std::vector<std::uint32_t> first_;  // index of each cell's first sphere, and the end
};

template <class Tell>
void SphereCells::eachNear(const SphereCells& others, std::size_t begin, std::size_t end,
                           const Tell& tell) const {
  // Within one SphereCells the rows before a cell's own, and the cells before it in its row, have been paired
  // with it already.
  const bool own = &others == this;
  const int firstRow = own ? 4 : 0;
  const auto rowOf = [&](std::size_t c, int row, int z) {
    return Cell{cells_[c].x + row / 3 - 1, cells_[c].y + row % 3 - 1, cells_[c].z + z};
  };
  std::array<std::size_t, 9> at{};
  for (int row = firstRow; row < 9 && begin < end; ++row)
    at[row] = static_cast<std::size_t>(std::ranges::lower_bound(others.cells_, rowOf(begin, row, -1)) -
                                       others.cells_.begin());
  for (std::size_t c = begin; c < end; ++c) {
    for (int row = firstRow; row < 9; ++row) {
      const Cell from = rowOf(c, row, -1), to = rowOf(c, row, 1);
      std::size_t& low = at[row];
      while (low < others.cells_.size() && others.cells_[low] < from) ++low;
      std::size_t high = low;
      while (high < others.cells_.size() && others.cells_[high] <= to) ++high;
      for (std::uint32_t i = first_[c]; i < first_[c + 1]; ++i) {
        const std::uint32_t firstOther = own && row == 4 ? i + 1 : others.first_[low];
        for (std::uint32_t j = firstOther; j < others.first_[high]; ++j)
          tell(spheres_[i], others.spheres_[j]);
      }
    }
  }
}

}  // namespace ringlet
