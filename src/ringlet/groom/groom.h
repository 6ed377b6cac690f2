// Groom: the strands of a file, in the file's unit and order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/assert.h"
#include "ringlet/base/vec3.h"

namespace ringlet {

/// Strands of any length, root first, one after the other.
struct Groom {
  std::vector<Vec3f> points;  // all particles of all strands [file unit]
  std::vector<std::uint32_t> firstPoint{
      0};  // strandCount + 1 entries; strand s is points[firstPoint[s] .. firstPoint[s+1])
  double metresPerUnit = 0.01;  // stated by the file, else by the user

  std::size_t strandCount() const { return firstPoint.size() - 1; }
  std::span<const Vec3f> strand(std::size_t s) const {
    return std::span(points).subspan(firstPoint[s], firstPoint[s + 1] - firstPoint[s]);
  }
  void addStrand(std::span<const Vec3f> strand) {
    points.insert(points.end(), strand.begin(), strand.end());
    firstPoint.push_back(static_cast<std::uint32_t>(points.size()));
  }
};

}  // namespace ringlet
