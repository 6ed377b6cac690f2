// DeviceGroom: the buffers of one groom on one device, chunk by chunk (groom_chunks.h), and the ways in and
// out of them. Constant and changing data never share a buffer; all upload at creation and in setState, all
// download here, in pieces, so that the host never holds a second copy of what it asked for.
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

/// What does not change of some of the strands; their firstParticle counts within the chunk. One for all
/// heads with this hair.
struct ConstantChunk {
  GroomChunk part;
  std::shared_ptr<gpu::Buffer> particles, strands;
  std::shared_ptr<const gpu::Buffer> framePlaces{};  // none on a processor (frame_readback.h)

  /// Fails when the device lacks memory.
  /// `strands`, `particles`, `factors`: all of the groom, in device order; no factors, or of each particle.
  static Result<ConstantChunk> create(gpu::Device& device, std::span<const layout::StrandRest> strands,
                                      std::span<const layout::ParticleRest> particles,
                                      std::span<const EdgeFactors> factors, const GroomChunk& part);
  /// Others in their place, while no kernel reads them.
  Status upload(std::span<const layout::StrandRest> all, std::span<const layout::ParticleRest> allParticles);
};

/// The particles of all chunks, from the device.
Result<std::vector<layout::ParticleRest>> particlesOf(std::span<const ConstantChunk> chunks);

/// What kernels see of some of the strands of one head.
struct DeviceChunk {
  GroomChunk part;
  std::shared_ptr<const gpu::Buffer> particles, strands, framePlaces;
  gpu::Buffer positions, velocities, reports, taps;
  gpu::Buffer solved, contactSystems, addedByVolume;  // empty unless needed (GroomRecords)
};

/// The largest buffer that a kernel may bind [bytes].
std::uint64_t mostBufferBytes(const gpu::Device& device, const KernelChoice& choice);

/// The chunks a device wants a groom in: as large as storage allows, and as texels do where it sees as many
/// as the smallest storage buffers hold, as kernels read those faster. With contacts a strand may meet any
/// other: all are in one. Fails, with the numbers, as cutGroom does and where the device has too little
/// memory left.
Result<std::vector<GroomChunk>> cutForDevice(const gpu::Device& device,
                                             std::span<const std::uint32_t> particleCounts,
                                             const GroomRecords& records, const Settings& settings,
                                             const KernelChoice& choice);

struct DeviceGroom {
  std::vector<DeviceChunk> chunks;
  gpu::Buffer contactControl;        // empty without contacts
  gpu::Buffer controlRead;           // as the last frame left it, in the host's memory
  bool hasOwnStrands = false;        // which no other head sees
  std::vector<ConstantChunk> own{};  // in place of what heads share, of all chunks; none: that
  std::optional<HeadPlace> place{};  // among other heads, of which all that changes is a part

  /// `shifted`: all strands in device order, of a head whose roots move beside it; else none. `places`: among
  /// which to take one, or null. Fails when the device lacks memory.
  static Result<DeviceGroom> create(gpu::Device& device, std::span<const ConstantChunk> constants,
                                    std::span<const layout::StrandRest> shifted, const GroomRecords& records,
                                    HeadPlaces* places);

  /// Constants of this head's own in place of the others; kernels must be bound to them anew. Fails when the
  /// device lacks memory.
  Status setConstants(gpu::Device& device, std::span<const layout::StrandRest> strands,
                      std::span<const layout::ParticleRest> particles, std::span<const EdgeFactors> factors);

  /// Whether all that does not change is what other heads see too.
  bool sharesConstants() const { return own.empty() && !hasOwnStrands; }

  /// A chunk's buffers, as strand kernels bind them.
  gpu::BufferTable bufferTable(std::size_t chunk) const;
  /// The largest buffer that kernels read as texels [bytes].
  std::uint64_t largestTexels() const;
  std::uint64_t particleBytes() const;  // of all buffers with a record a particle
  std::uint64_t strandBytes() const;
  /// Of these, what other heads see too.
  std::uint64_t sharedBytes() const;

  /// With contacts a frame ends with it, after a barrier: what its control block says comes to the host.
  void recordControl(gpu::CommandList& list) const;
  /// What the last frame that has ended left in it.
  const layout::ContactControl& control() const;

  /// In device order.
  Result<std::vector<layout::StrandReport>> downloadReports() const;

  using Field = gpu::Buffer DeviceChunk::*;
  /// Fills a buffer of vec4s a particle: valueAt(i) of particle i, device order, asked for in that order.
  template <class ValueAt>
  Status uploadEach(Field field, ValueAt&& valueAt);
  /// Each value to change(value).
  template <class Change>
  Status changeEach(Field field, Change&& change);
  /// take(i, value) for each particle, in device order; from the `row`th row of all particles on (taps).
  template <class Take>
  Status downloadEach(Field field, Take&& take, std::uint64_t row = 0) const;
};

/// The groom's index of each particle, in device order.
std::vector<std::uint32_t> groomIndices(const RestState& rest);

/// The same one by one, asked for in device order: which strand, and where in the groom, particle i is.
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

// What crosses at once: 16 MiB of vec4s.
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
