// HeadPlaces: where heads of one asset stand on the device. The buffers of a head are parts of larger ones, a
// row, in which heads stand one behind the other, so that one dispatch can step many of them (RINGLET_HEADS
// of shared/strand_buffers.glsl).
//
//   row   | head 0 | head 1 | free | head 3 | ...
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/solver/plan/groom_chunks.h"

namespace ringlet {

/// Of one or more heads, one behind the other.
struct HeadBuffers {
  gpu::Buffer positions, velocities, reports, poses;

  /// As strand kernels bind them.
  gpu::BufferTable bufferTable() const;
};

/// Records from one head to the next.
struct HeadStrides {
  std::uint32_t particles = 0, strands = 0, stepPoses = 0;
};

struct HeadRow {
  GroomChunk part;  // of each head
  GroomRecords records;
  HeadBuffers buffers;
  HeadStrides strides;
  std::vector<bool> isTaken;  // by place

  std::uint64_t largestBuffer() const { return std::max(buffers.positions.bytes(), buffers.poses.bytes()); }
};

/// One head's place in a row, which it keeps; free again with its end.
class HeadPlace {
 public:
  HeadPlace(HeadPlace&&) = default;
  HeadPlace& operator=(HeadPlace&&) = default;

  const HeadRow& row() const { return *row_; }
  std::uint32_t number() const { return number_; }
  /// Its part of the row's buffers, and those of the heads behind it: `heads` in all. Fails when the device
  /// lacks memory.
  Result<HeadBuffers> part(std::uint32_t heads) const;

 private:
  friend class HeadPlaces;
  HeadPlace(std::shared_ptr<HeadRow> row, std::uint32_t number, std::shared_ptr<void> taken)
      : row_(std::move(row)), number_(number), taken_(std::move(taken)) {}

  std::shared_ptr<HeadRow> row_;
  std::uint32_t number_ = 0;
  std::shared_ptr<void> taken_;  // frees the place
};

/// For any thread.
class HeadPlaces {
 public:
  /// For about `heads` heads whose hair is one chunk. None where a head is so large that a dispatch of its
  /// own serves it as well, or the device sees no two heads' poses as texels. Fails when the device lacks
  /// memory.
  static Result<std::shared_ptr<HeadPlaces>> create(gpu::Device& device, const GroomChunk& part,
                                                    const GroomRecords& records, int heads);

  std::uint32_t headsOfRow() const { return heads_; }
  /// The first free place; where there is none, in a new row. Fails when the device lacks memory.
  Result<HeadPlace> take();

 private:
  HeadPlaces(gpu::Device& device, const GroomChunk& part, const GroomRecords& records,
             const HeadStrides& strides, std::uint32_t heads)
      : device_(device.shared_from_this()),
        part_(part),
        records_(records),
        strides_(strides),
        heads_(heads) {}
  Result<HeadRow> makeRow() const;

  std::shared_ptr<gpu::Device> device_;
  GroomChunk part_;
  GroomRecords records_;
  HeadStrides strides_;
  std::uint32_t heads_ = 0;  // of a row
  std::shared_ptr<std::mutex> guard_ =
      std::make_shared<std::mutex>();  // of what follows and whose places are taken
  std::vector<std::shared_ptr<HeadRow>> rows_;
};

}  // namespace ringlet
