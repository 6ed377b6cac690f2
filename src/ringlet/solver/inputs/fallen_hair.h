// FallenHair: what was cut off strands. Its particles keep their indices, so contacts and everything else
// that reads positions is unaffected. Kernels of its own step it (kernels/strand_step.comp, kFalls), with
// records of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/strands.h"
#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scene/strand_cut.h"
#include "ringlet/solver/inputs/frame_input.h"
#include "ringlet/solver/plan/groom_chunks.h"
#include "ringlet/solver/plan/shape_plan.h"

namespace ringlet {

/// Particles that were cut off a strand (device order) together. Their record on the device begins with the
/// particle before them, which stays with the strand: in the record it is pinned, and the edge from it is
/// void.
struct FallenPiece {
  std::uint32_t strand = 0;
  std::uint32_t begin = 0, end = 0;  // particles, counted along the strand
  Quatd restTurn{};                  // turns its rest pose: the head's rotation when it was cut
  layout::StrandReport report{};     // saved while the pieces are put in order

  std::uint32_t count() const { return end - begin; }
};

class FallenHair : public FrameInput {
 public:
  /// Nothing is cut.
  static Result<FallenHair> create(const InputSource& from);

  /// Sorted by strand, and along each strand from the root.
  std::span<const FallenPiece> pieces() const { return pieces_; }
  /// Ranges of pieces, in the shapes of the strands they were cut off. The reference is valid as long as
  /// this.
  const std::vector<StrandRange>& ranges() const { return ranges_; }
  /// Number of particles of a strand (device order) that are still attached to its root.
  std::uint32_t keptOf(std::size_t strand) const {
    return kept_.empty() ? rest_->strands[strand].particleCount : kept_[strand];
  }
  /// Device indices of fallen particles, ascending.
  std::vector<std::uint32_t> particles() const;
  /// One report per piece.
  Result<std::vector<layout::StrandReport>> reports() const;

  /// Fails, with the numbers, where a cut keeps fewer particles than `least`, or all that there are.
  Status check(std::span<const StrandCut> cuts, std::uint32_t least) const;
  /// `ranges`: those of whole strands. Afterwards kernels for the new ranges must be made. Fails when the
  /// device lacks memory.
  Status cut(gpu::Device& device, std::span<const StrandCut> cuts, Quatd headRotation,
             std::span<const StrandRange> ranges);
  /// Changes to the shapes of other ranges of whole strands; kernels and records must then be made anew.
  Status reshape(gpu::Device& device, std::span<const StrandRange> ranges);
  /// Restricts records of whole strands and of their particles to what is kept; returns the records of the
  /// pieces.
  std::vector<layout::StrandRest> restrict(std::span<layout::StrandRest> of,
                                           std::span<layout::ParticleRest> particles) const;
  /// Uploads the records that `restrict` returned.
  Status setRecords(std::span<const layout::StrandRest> ofPieces);

  void writeFrame(std::size_t, const FrameContext&) override {}
  Status archive(Archive& archive) override;
  gpu::BufferTable bufferTable(std::size_t) const override { return {}; }
  /// The bindings that kernels of fallen hair use in place of the strands'.
  gpu::BufferTable pieceTable(std::size_t chunk) const;
  std::uint64_t bytes() const override;

 private:
  std::uint64_t DeviceMemory::*kind() const override;
  // The device's records of the pieces of a chunk; the pieces' particles are in the chunk's own buffers.
  struct Records {
    gpu::Buffer strands, reports;
  };
  FallenHair(const RestState& rest, std::span<const GroomChunk> chunks) : rest_(&rest), chunks_(chunks) {}
  Status keepReports();
  Status makeRecords(gpu::Device& device, std::span<const StrandRange> ranges);

  const RestState* rest_;
  std::span<const GroomChunk> chunks_;
  std::vector<std::uint32_t> kept_;  // of each strand, once some were cut
  std::vector<FallenPiece> pieces_;
  std::vector<Records> records_;  // of each chunk
  std::vector<StrandRange> ranges_;
};

}  // namespace ringlet
