// Implements solver/frame_slot.h.
#include "ringlet/solver/frame_slot.h"

#include <utility>

#include "ringlet/solver/packed.h"

namespace ringlet {

Result<FrameSlot> FrameSlot::create(gpu::Device& device, const DeviceGroom& groom, bool readsBack) {
  auto recorder = gpu::Recorder::create(device, "frame");
  if (!recorder) return recorder.error();
  std::vector<gpu::Buffer> positions;
  for (const DeviceChunk& chunk : groom.chunks) {
    if (!readsBack) break;
    auto buffer =
        gpu::Buffer::create(device, chunk.positions.bytes(), gpu::BufferKind::stream, "positions read back");
    if (!buffer) return buffer.error();
    positions.push_back(std::move(*buffer));
  }
  return FrameSlot{.positions = std::move(positions), .recorder = std::move(*recorder)};
}

void FrameSlot::recordPositions(gpu::CommandList& list, const DeviceGroom& groom) const {
  list.barrier();
  for (std::size_t c = 0; c < positions.size(); ++c)
    list.copyBuffer(groom.chunks[c].positions, positions[c], positions[c].bytes());
}

Status FrameSlot::downloadPositions(const DeviceGroom& groom) {
  for (std::size_t c = 0; c < positions.size(); ++c) {
    if (Status status = groom.chunks[c].positions.download(positions[c].mapped()); !status) return status;
  }
  return {};
}

std::vector<Vec3f> FrameSlot::inGroomOrder(const RestState& rest, const DeviceGroom& groom,
                                           const RigidHair& rigidHair) const {
  std::vector<Vec3f> values(rest.groomParticleCount);
  for (std::size_t c = 0; c < positions.size(); ++c) {
    const GroomChunk& part = groom.chunks[c].part;
    const auto* read = reinterpret_cast<const layout::vec4*>(positions[c].mapped().data());
    for (std::size_t s = part.strandBegin; s < part.strandEnd; ++s) {
      const std::size_t from = rest.strands[s].firstParticle - part.particleBegin, to = rest.firstInGroom[s];
      for (std::size_t i = 0; i < rest.strands[s].particleCount; ++i)
        values[to + i] = unpacked(read[from + i]);
    }
  }
  rigidHair.scatter(rigid, values);
  return values;
}

std::uint64_t FrameSlot::bytes() const {
  std::uint64_t bytes = 0;
  for (const gpu::Buffer& buffer : positions) bytes += buffer.bytes();
  return bytes;
}

}  // namespace ringlet
