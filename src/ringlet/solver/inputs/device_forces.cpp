// Implements solver/inputs/device_forces.h.
#include "ringlet/solver/inputs/device_forces.h"

#include <algorithm>
#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/base/packed.h"
#include "ringlet/solver/strands/device_groom.h"

namespace ringlet {

Result<DeviceForces> DeviceForces::create(gpu::Device& device, const RestState& rest, bool areThere,
                                          std::span<const GroomChunk> chunks, std::size_t slots) {
  DeviceForces forces(areThere, slots);
  forces.chunks_.assign(chunks.begin(), chunks.end());
  for (const GroomChunk& chunk : chunks) {
    const std::uint64_t particles = areThere ? chunk.particleCount() : 0;
    auto input = FrameInput::create(device, particles * sizeof(layout::vec4), slots, "forces from outside");
    if (!input) return input.error();
    forces.inputs_.push_back(std::move(*input));
  }
  if (areThere) {
    forces.groomIndices_ = groomIndices(rest);
    forces.now_.resize(forces.groomIndices_.size());
  }
  return forces;
}

void DeviceForces::set(std::span<const Vec3f> forces) {
  for (std::size_t i = 0; i < now_.size(); ++i) now_[i] = packed(forces[groomIndices_[i]]);
  isWritten_.assign(isWritten_.size(), false);
}

void DeviceForces::writeFrame(std::size_t slot) {
  if (!areThere_ || isWritten_[slot]) return;
  for (std::size_t c = 0; c < chunks_.size(); ++c)
    std::copy_n(now_.begin() + chunks_[c].particleBegin, chunks_[c].particleCount(),
                inputs_[c].of<layout::vec4>(slot).begin());
  isWritten_[slot] = true;
}

}  // namespace ringlet
