// FallenHair: what was cut off strands. It keeps its particles: contacts and all that reads positions know no
// difference. Kernels of its own step it (kernels/strand_step.comp, kFalls), from records of its own.
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

/// Particles of a strand, device order, that were cut off it together. Its record on the device begins with
/// the particle before them, which is the strand's: it is pinned, and the edge from it void.
struct FallenPiece {
  std::uint32_t strand = 0;
  std::uint32_t begin = 0, end = 0;  // particles, counted along the strand
  Quatd restTurn{};                  // of its rest pose: the head's when it was cut
  layout::StrandReport report{};     // while the pieces are put in order

  std::uint32_t count() const { return end - begin; }
};

class FallenHair : public FrameInput {
 public:
  /// Nothing is cut.
  static Result<FallenHair> create(const InputSource& from);

  /// By strand, and from its root on.
  std::span<const FallenPiece> pieces() const { return pieces_; }
  /// In the shapes of the strands that pieces were of; in one place as long as this.
  const std::vector<StrandRange>& ranges() const { return ranges_; }
  /// Particles of a strand, device order, that its root holds.
  std::uint32_t keptOf(std::size_t strand) const {
    return kept_.empty() ? rest_->strands[strand].particleCount : kept_[strand];
  }
  /// Device indices of what fell, ascending.
  std::vector<std::uint32_t> particles() const;
  /// By piece.
  Result<std::vector<layout::StrandReport>> reports() const;

  /// Fails, with the numbers, where a cut keeps fewer particles than `least`, or all that there are.
  Status check(std::span<const StrandCut> cuts, std::uint32_t least) const;
  /// `ranges`: of whole strands. Kernels of the new ranges are to be made. Fails when the device lacks
  /// memory.
  Status cut(gpu::Device& device, std::span<const StrandCut> cuts, Quatd headRotation,
             std::span<const StrandRange> ranges);
  /// In the shapes of other ranges of whole strands; kernels and records are then to be made anew.
  Status reshape(gpu::Device& device, std::span<const StrandRange> ranges);
  /// Of whole strands and their particles what each keeps; returns the records of the pieces.
  std::vector<layout::StrandRest> restrict(std::span<layout::StrandRest> of,
                                           std::span<layout::ParticleRest> particles) const;
  /// Uploads these.
  Status setRecords(std::span<const layout::StrandRest> ofPieces);

  void writeFrame(std::size_t, const FrameContext&) override {}
  Status archive(Archive& archive) override;
  gpu::BufferTable bufferTable(std::size_t) const override { return {}; }
  /// What kernels of fallen hair bind in place of the strands'.
  gpu::BufferTable pieceTable(std::size_t chunk) const;
  std::uint64_t bytes() const override;

 private:
  std::uint64_t DeviceMemory::*kind() const override;
  // What the device has of the pieces of a chunk's strands; their particles are the chunk's.
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
