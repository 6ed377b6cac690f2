// ForcesInput: external forces on particles; empty for hair without the feature.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/strands.h"
#include "ringlet/base/vec3.h"
#include "ringlet/solver/inputs/frame_input.h"
#include "ringlet/solver/plan/groom_chunks.h"

namespace ringlet {

class ForcesInput : public FrameInput {
 public:
  /// All forces are 0 at first. Fails when the device lacks memory.
  static Result<ForcesInput> create(const InputSource& from);

  /// Sets the force per kilogram of every particle, groom order [m/s^2], from the next written frame on.
  void set(std::span<const Vec3f> forces);

  Status prepare(const InputSource& from) override;
  void writeFrame(std::size_t slot, const FrameContext&) override;
  gpu::BufferTable bufferTable(std::size_t chunk) const override;

 private:
  std::uint64_t DeviceMemory::*kind() const override;
  ForcesInput() = default;

  bool areThere_ = false;
  std::span<const GroomChunk> chunks_;       // staged, of each: vec4[particle]
  std::vector<std::uint32_t> groomIndices_;  // of each particle, in device order
  std::vector<layout::vec4> now_;            // in device order
  std::vector<bool> isWritten_;              // by slot: the slot has the present forces
};

}  // namespace ringlet
