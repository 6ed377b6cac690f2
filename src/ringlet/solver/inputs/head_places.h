// HeadPlaces: shared buffers for heads of one asset. A head's buffers are parts of larger ones, a row, in
// which heads follow one another, so that one dispatch can step many of them (RINGLET_HEADS of
// shared/strand_buffers.glsl).
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

/// The buffers of one head or of several consecutive ones.
struct HeadBuffers {
  gpu::Buffer positions, velocities, reports, poses;

  /// Bindings of strand kernels.
  gpu::BufferTable bufferTable() const;
};

/// Number of records from the start of one head to that of the next.
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

/// The place of one head in a row. Its destructor frees the place.
class HeadPlace {
 public:
  HeadPlace(HeadPlace&&) = default;
  HeadPlace& operator=(HeadPlace&&) = default;

  const HeadRow& row() const { return *row_; }
  std::uint32_t number() const { return number_; }
  /// The part of the row's buffers that begins with this head and holds `heads` heads. Fails when the device
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

/// Thread-safe.
class HeadPlaces {
 public:
  /// Plans for about `heads` heads whose hair is one chunk. Returns null where a head is so large that a
  /// dispatch of its own is as fast, or where the device cannot read two heads' poses as texels. Fails when
  /// the device lacks memory.
  static Result<std::shared_ptr<HeadPlaces>> create(gpu::Device& device, const GroomChunk& part,
                                                    const GroomRecords& records, int heads);

  std::uint32_t headsOfRow() const { return heads_; }
  /// Takes the first free place; adds a row if there is none. Fails when the device lacks memory.
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
      std::make_shared<std::mutex>();  // protects the rows and which of their places are taken
  std::vector<std::shared_ptr<HeadRow>> rows_;
};

}  // namespace ringlet
