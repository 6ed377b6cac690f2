// NearestPoints: a k-d tree (Bentley 1975) stored in the sorted points themselves: a range's middle point
// splits it; points left of it are below it on the range's axis.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/vec3.h"

namespace ringlet {

class NearestPoints {
 public:
  struct Near {
    double distance = 0;
    std::uint32_t point = 0;  // its place in the span
  };

  /// Copies the points, all finite. Cost: n log n.
  explicit NearestPoints(std::span<const Vec3d> points);

  /// Sets `found` to the `count` points nearest to a place, nearest first, or to all where there are fewer.
  /// Which of points equally far are among them is the same on every run. Cost: log n times the count, and
  /// no more where many points are one.
  void find(Vec3d place, std::size_t count, std::vector<Near>& found) const;

 private:
  struct Entry {
    Vec3d at;
    std::uint32_t point;
  };

  void divide(std::size_t begin, std::size_t end);
  int widestAxis(std::size_t begin, std::size_t end) const;
  void search(std::size_t begin, std::size_t end, Vec3d place, std::size_t count,
              std::vector<Near>& found) const;

  std::vector<Entry> entries_;
  std::vector<int> axes_;  // that each middle point splits
};

}  // namespace ringlet
