// StretchColours: hairs in the colour of how far their strands are stretched, found on the device: the look's
// first pigment at rest, its last where an edge is so much longer.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/gpu/bound_kernel.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/command_list.h"

namespace ringlet {

class StretchColours {
 public:
  /// `points`: of strands on the device, three coordinates and anything [m]; `rest`: the same at rest.
  /// `firstPoint`: of each strand, and one more. `strandOf`: of each hair, the strand that it is or follows.
  /// `drawn`: HairRenderer::drawnHairs. Buffers live as long. Errors: the device lacks memory.
  static Result<StretchColours> create(gpu::Device& device, const gpu::Buffer& points,
                                       std::span<const Vec3d> rest, std::span<const std::uint32_t> firstPoint,
                                       std::span<const std::uint32_t> strandOf, const gpu::Buffer& drawn);
  StretchColours(StretchColours&&) = default;
  StretchColours& operator=(StretchColours&&) = default;

  /// Of the points as they are then. `most`: share of its length by which an edge of the last colour is
  /// longer. Ends with a barrier.
  void record(gpu::CommandList& list, double most = 0.05) const;

 private:
  StretchColours(gpu::Buffer lengths, gpu::Buffer strands)
      : lengths_(std::move(lengths)), strands_(std::move(strands)) {}

  gpu::Buffer lengths_, strands_;
  std::optional<gpu::BoundKernel> kernel_;  // once made
  std::uint32_t hairCount_ = 0;
};

}  // namespace ringlet
