// DeviceGroom: the buffers of one groom on one device, chunk by chunk (groom_chunks.h), and how to write and
// read them. Constant and changing data never share a buffer. All uploads at creation and in setState, and
// all downloads here are done in pieces, so that the host never holds a second copy of the data.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "layout/contacts.h"
#include "layout/strands.h"
#include "ringlet/base/result.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/solver/inputs/head_places.h"
#include "ringlet/solver/plan/groom_chunks.h"

namespace ringlet {

/// The constants of a chunk of strands; their firstParticle counts within the chunk. All heads with this hair
/// share them.
struct ConstantChunk {
  GroomChunk part;
  std::shared_ptr<gpu::Buffer> particles, strands;
  std::shared_ptr<const gpu::Buffer> framePlaces{};  // none on a CPU device (frame_readback.h)

  /// `strands`, `particles`, `factors`: of the whole groom, in device order; factors: one per particle, or
  /// none. Fails when the device lacks memory.
  static Result<ConstantChunk> create(gpu::Device& device, std::span<const layout::StrandRest> strands,
                                      std::span<const layout::ParticleRest> particles,
                                      std::span<const EdgeFactors> factors, const GroomChunk& part);
  /// Replaces the constants. No kernel may be reading them.
  Status upload(std::span<const layout::StrandRest> all, std::span<const layout::ParticleRest> allParticles);
};

/// Downloads the particles of all chunks.
Result<std::vector<layout::ParticleRest>> particlesOf(std::span<const ConstantChunk> chunks);

/// The buffers that kernels use for a chunk of strands of one head.
struct DeviceChunk {
  GroomChunk part;
  std::shared_ptr<const gpu::Buffer> particles, strands, framePlaces;
  gpu::Buffer positions, velocities, reports, taps;
  gpu::Buffer solved, contactSystems, addedByVolume;  // empty unless needed (GroomRecords)
};

/// The largest buffer that a kernel may bind [bytes].
std::uint64_t mostBufferBytes(const gpu::Device& device, const KernelChoice& choice);

/// The chunks for a groom on this device: as large as storage buffers allow; or, if texel buffers may be at
/// least as large as the smallest limit of storage buffers, as large as these allow, since kernels read
/// texels faster. With contacts all strands are in one chunk, since any may touch any other. Fails, with the
/// numbers, as cutGroom does and where the device has too little memory left.
Result<std::vector<GroomChunk>> cutForDevice(const gpu::Device& device,
                                             std::span<const std::uint32_t> particleCounts,
                                             const GroomRecords& records, const Settings& settings,
                                             const KernelChoice& choice);

struct DeviceGroom {
  std::vector<DeviceChunk> chunks;
  gpu::Buffer contactControl;        // empty without contacts
  gpu::Buffer controlRead;           // the control block as the last frame left it, in host memory
  bool hasOwnStrands = false;        // not shared with other heads
  std::vector<ConstantChunk> own{};  // constants of this head, per chunk, in place of the shared ones; empty:
                                     // the shared ones are used
  std::optional<HeadPlace> place{};  // if its changing data is part of a row of heads

  /// `shifted`: all strands in device order, for a head with shifted roots; else empty. `places`: where to
  /// take a place from, or null. Fails when the device lacks memory.
  static Result<DeviceGroom> create(gpu::Device& device, std::span<const ConstantChunk> constants,
                                    std::span<const layout::StrandRest> shifted, const GroomRecords& records,
                                    HeadPlaces* places);

  /// Gives this head constants of its own; kernels must be bound to them anew. Fails when the device lacks
  /// memory.
  Status setConstants(gpu::Device& device, std::span<const layout::StrandRest> strands,
                      std::span<const layout::ParticleRest> particles, std::span<const EdgeFactors> factors);

  /// Whether all constants are shared with other heads.
  bool sharesConstants() const { return own.empty() && !hasOwnStrands; }

  /// Bindings of the strand kernels for a chunk.
  gpu::BufferTable bufferTable(std::size_t chunk) const;
  /// The largest buffer that kernels read as texels [bytes].
  std::uint64_t largestTexels() const;
  std::uint64_t particleBytes() const;  // of all buffers with a record a particle
  std::uint64_t strandBytes() const;
  /// The part of both that is shared with other heads.
  std::uint64_t sharedBytes() const;

  /// With contacts: recorded at the end of a frame, after a barrier. Copies the control block to the host.
  void recordControl(gpu::CommandList& list) const;
  /// The control block of the last frame that has ended.
  const layout::ContactControl& control() const;

  /// In device order.
  Result<std::vector<layout::StrandReport>> downloadReports() const;

  using Field = gpu::Buffer DeviceChunk::*;
  /// Fills a buffer of one vec4 per particle with valueAt(i), which is called for each particle i in device
  /// order.
  template <class ValueAt>
  Status uploadEach(Field field, ValueAt&& valueAt);
  /// Replaces each value by change(value).
  template <class Change>
  Status changeEach(Field field, Change&& change);
  /// Calls take(i, value) for each particle, in device order; row: reads the `row`th row of all particles
  /// (taps).
  template <class Take>
  Status downloadEach(Field field, Take&& take, std::uint64_t row = 0) const;
};

/// The groom's index of each particle, in device order.
std::vector<std::uint32_t> groomIndices(const RestState& rest);

/// The same one by one, in device order: the strand of particle i, and its index in the groom.
class GroomPlaces {
 public:
  explicit GroomPlaces(const RestState& rest) : rest_(&rest) {}
  std::size_t strandOf(std::size_t i) {
    while (i >= rest_->strands[strand_].firstParticle + std::size_t{rest_->strands[strand_].particleCount})
      ++strand_;
    return strand_;
  }
  std::size_t operator()(std::size_t i) {
    const std::size_t s = strandOf(i);
    return rest_->firstInGroom[s] + i - rest_->strands[s].firstParticle;
  }

 private:
  const RestState* rest_;
  std::size_t strand_ = 0;
};

// Records per transfer: 16 MiB of vec4s.
inline constexpr std::size_t kPieceRecords = 1 << 20;

template <class ValueAt>
Status DeviceGroom::uploadEach(Field field, ValueAt&& valueAt) {
  std::vector<layout::vec4> piece;
  for (DeviceChunk& chunk : chunks) {
    for (std::size_t done = 0; done < chunk.part.particleCount(); done += piece.size()) {
      piece.resize(std::min(kPieceRecords, chunk.part.particleCount() - done));
      for (std::size_t k = 0; k < piece.size(); ++k) piece[k] = valueAt(chunk.part.particleBegin + done + k);
      if (Status status = (chunk.*field).upload(std::as_bytes(std::span(piece)), done * sizeof(layout::vec4));
          !status)
        return status;
    }
  }
  return {};
}

template <class Change>
Status DeviceGroom::changeEach(Field field, Change&& change) {
  for (DeviceChunk& chunk : chunks) {
    const std::size_t count = chunk.part.particleCount();
    for (std::size_t done = 0; done < count; done += kPieceRecords) {
      auto piece = downloadAll<layout::vec4>(chunk.*field, std::min(kPieceRecords, count - done), done);
      if (!piece) return piece.error();
      for (layout::vec4& value : *piece) value = change(value);
      if (Status status =
              (chunk.*field).upload(std::as_bytes(std::span(*piece)), done * sizeof(layout::vec4));
          !status)
        return status;
    }
  }
  return {};
}

template <class Take>
Status DeviceGroom::downloadEach(Field field, Take&& take, std::uint64_t row) const {
  for (const DeviceChunk& chunk : chunks) {
    const std::size_t count = chunk.part.particleCount();
    for (std::size_t done = 0; done < count; done += kPieceRecords) {
      const auto piece =
          downloadAll<layout::vec4>(chunk.*field, std::min(kPieceRecords, count - done), row * count + done);
      if (!piece) return piece.error();
      for (std::size_t k = 0; k < piece->size(); ++k) take(chunk.part.particleBegin + done + k, (*piece)[k]);
    }
  }
  return {};
}

}  // namespace ringlet
