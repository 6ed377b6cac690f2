// The points of one frame as the content of a cache's chunk (cache_format.h), and back.
//
//   float32   planes of the floats' bits
//   16 bit    step f32 | of each strand the low corner of its box: x y z f32 | planes of the steps from there
//
// Planes: all x, then all y, then all z, as differences from the number before; then byte by byte, the
// highest bytes of all numbers first. Of neighbours on a strand these are nearly the same, which is what zstd
// finds. Floats count away from zero, so their differences have either sign: the sign goes to the lowest bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/output/cache_format.h"

namespace ringlet::cache {

/// Bytes of a frame's content.
std::uint64_t frameBytes(CachePrecision precision, std::uint64_t strandCount, std::uint64_t particleCount);

/// Encodes frames; keeps its memory from one to the next. `firstPoint` is a groom's.
class FrameEncoder {
 public:
  /// The content, good until the next call. Points are finite. Cost: 0.3 ms for 64,000 points.
  std::span<const std::byte> encode(CachePrecision precision, std::span<const std::uint32_t> firstPoint,
                                    std::span<const Vec3f> points);

  /// The farthest that a decoded point of the latest frame may be from its own [file unit]; 0 for float32.
  double errorBound() const { return errorBound_; }

 private:
  void encodeSteps(std::span<const std::uint32_t> firstPoint, std::span<const Vec3f> points);

  double errorBound_ = 0;
  std::vector<std::byte> content_;
  std::vector<std::uint32_t> bits_;
  std::vector<std::uint16_t> steps_;
};

/// Fills `points` from a content of frameBytes() bytes; false if one of them is not finite.
bool decodeFrame(CachePrecision precision, std::span<const std::uint32_t> firstPoint,
                 std::span<const std::byte> content, std::span<Vec3f> points);

}  // namespace ringlet::cache
