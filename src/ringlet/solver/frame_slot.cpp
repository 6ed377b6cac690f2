// Implements solver/frame_slot.h.
#include "ringlet/solver/frame_slot.h"

#include <algorithm>
#include <utility>

#include "ringlet/base/packed.h"

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

std::vector<std::span<const layout::vec4>> FrameSlot::readPositions() const {
  std::vector<std::span<const layout::vec4>> chunks;
  for (const gpu::Buffer& buffer : positions) {
    const auto bytes = buffer.mapped();
    chunks.emplace_back(reinterpret_cast<const layout::vec4*>(bytes.data()),
                        bytes.size() / sizeof(layout::vec4));
  }
  return chunks;
}

void FrameSlot::scatter(const RestState& rest, const DeviceGroom& groom, const RigidHair& rigidHair,
                        std::span<Vec3f> inGroomOrder) const {
  const auto chunks = readPositions();
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    const GroomChunk& part = groom.chunks[c].part;
    const std::size_t end = std::min<std::size_t>(part.strandEnd, hereCount(rest));
    for (std::size_t s = part.strandBegin; s < end; ++s) {
      const std::size_t from = rest.strands[s].firstParticle - part.particleBegin, to = rest.firstInGroom[s];
      for (std::size_t i = 0; i < rest.strands[s].particleCount; ++i)
        inGroomOrder[to + i] = unpacked(chunks[c][from + i]);
    }
  }
  rigidHair.scatter(rigid, inGroomOrder);
}

std::uint64_t FrameSlot::bytes() const {
  std::uint64_t bytes = 0;
  for (const gpu::Buffer& buffer : positions) bytes += buffer.bytes();
  return bytes;
}

}  // namespace ringlet
