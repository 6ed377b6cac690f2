// StrandPoints: strands from the host as a renderer takes them (DrawnHairs::points).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/gpu/buffer.h"

namespace ringlet {

class StrandPoints {
 public:
  /// `firstPoint`: of each strand, and one more. Errors: the device has too little memory.
  static Result<StrandPoints> create(gpu::Device& device, std::vector<std::uint32_t> firstPoint);

  /// The points of a pose in units of `metresPerUnit`, in order. Nothing may be using the old ones.
  /// `cutBeyond`: points from which no edge goes on, as the strand is cut there.
  Status setPose(std::span<const Vec3f> points, double metresPerUnit,
                 std::span<const std::uint32_t> cutBeyond = {});

  const gpu::Buffer& points() const { return points_; }
  const std::vector<std::uint32_t>& firstPoint() const { return firstPoint_; }

 private:
  StrandPoints(gpu::Buffer points, std::vector<std::uint32_t> firstPoint)
      : points_(std::move(points)), firstPoint_(std::move(firstPoint)) {}

  gpu::Buffer points_;
  std::vector<std::uint32_t> firstPoint_;
};

}  // namespace ringlet
