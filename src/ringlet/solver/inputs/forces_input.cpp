// Implements solver/inputs/forces_input.h.
#include "ringlet/solver/inputs/forces_input.h"

#include <algorithm>
#include <utility>

#include "ringlet/base/packed.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/inputs/frame_inputs.h"
#include "ringlet/solver/strands/device_groom.h"

namespace ringlet {

Result<ForcesInput> ForcesInput::create(const InputSource& from) {
  ForcesInput self;
  self.chunks_ = from.chunks;
  self.isWritten_.assign(from.slots, false);
  if (Status status = self.prepare(from); !status) return status.error();
  return self;
}

Status ForcesInput::prepare(const InputSource& from) {
  if (areThere_ == from.features.forces && !staged_.empty()) return {};
  areThere_ = from.features.forces;
  staged_.clear();
  for (const GroomChunk& chunk : chunks_) {
    const std::uint64_t particles = areThere_ ? chunk.particleCount() : 0;
    if (Status status = stage(from, particles * sizeof(layout::vec4), "forces from outside"); !status)
      return status;
  }
  if (!areThere_) return {};
  groomIndices_ = groomIndices(from.rest);
  now_.resize(groomIndices_.size());
  return {};
}

void ForcesInput::set(std::span<const Vec3f> forces) {
  for (std::size_t i = 0; i < now_.size(); ++i) now_[i] = packed(forces[groomIndices_[i]]);
  isWritten_.assign(isWritten_.size(), false);
}

void ForcesInput::writeFrame(std::size_t slot, const FrameContext&) {
  if (!areThere_ || isWritten_[slot]) return;
  for (std::size_t c = 0; c < chunks_.size(); ++c)
    std::copy_n(now_.begin() + chunks_[c].particleBegin, chunks_[c].particleCount(),
                staged_[c].of<layout::vec4>(slot).begin());
  isWritten_[slot] = true;
}

gpu::BufferTable ForcesInput::bufferTable(std::size_t chunk) const {
  return {{layout::kBindOutsideForces, staged_[chunk].seen()},
          {layout::kBindOutsideForceTexels, staged_[chunk].seen()}};
}

std::uint64_t DeviceMemory::*ForcesInput::kind() const { return &DeviceMemory::particles; }

}  // namespace ringlet
