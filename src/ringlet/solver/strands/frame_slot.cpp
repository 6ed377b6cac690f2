// Implements solver/strands/frame_slot.h.
#include "ringlet/solver/strands/frame_slot.h"

#include <algorithm>
#include <utility>

namespace ringlet {

Result<FrameSlot> FrameSlot::create(gpu::Device& device, const DeviceGroom& groom, const FramePlaces& places,
                                    std::uint64_t mostBufferBytes, bool readsBack) {
  auto recorder = gpu::Recorder::create(device, "frame");
  if (!recorder) return recorder.error();
  FrameSlot slot{.recorder = std::move(*recorder)};
  if (!readsBack) return slot;
  auto readback = FrameReadback::create(device, groom, places.count, mostBufferBytes);
  if (!readback) return readback.error();
  slot.readback = std::move(*readback);
  return slot;
}

void FrameSlot::recordPositions(gpu::CommandList& list) const {
  list.barrier();
  if (readback) readback->record(list);
}

Status FrameSlot::downloadPositions(const FramePlaces& places) {
  return readback ? readback->download(places) : Status{};
}

void FrameSlot::copyPositions(const RestState& rest, const FramePlaces& places, const RigidHair& rigidHair,
                              std::span<Vec3f> inGroomOrder) const {
  const std::span<const Vec3f> from = positions();
  if (places.areOfGroom) {
    std::ranges::copy(from, inGroomOrder.begin());
  } else {
    for (std::size_t s = 0; s < hereCount(rest); ++s) {
      const auto strand = from.subspan(rest.strands[s].firstParticle, rest.strands[s].particleCount);
      std::ranges::copy(strand, inGroomOrder.begin() + rest.firstInGroom[s]);
    }
  }
  rigidHair.scatter(rigid, inGroomOrder);
}

std::span<const Vec3f> FrameSlot::viewPositions(const RigidHair& rigidHair) const {
  if (!readback) return {};
  rigidHair.scatter(rigid, readback->positions());
  return readback->positions();
}

}  // namespace ringlet
