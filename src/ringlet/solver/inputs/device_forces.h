// DeviceForces: external forces on the particles of one head; empty if the hair was built without.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/strands.h"
#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/solver/inputs/frame_input.h"
#include "ringlet/solver/plan/groom_chunks.h"

namespace ringlet {

class DeviceForces {
 public:
  /// All forces are 0 at first. `slots`: frames in flight. Fails if the device lacks memory.
  static Result<DeviceForces> create(gpu::Device& device, const RestState& rest, bool areThere,
                                     std::span<const GroomChunk> chunks, std::size_t slots);

  bool areThere() const { return areThere_; }

  /// Bindings of the strand kernels, of a chunk.
  gpu::BufferTable bufferTable(std::size_t chunk) const {
    return {{layout::kBindOutsideForces, inputs_[chunk].seen()},
            {layout::kBindOutsideForceTexels, inputs_[chunk].seen()}};
  }
  std::uint64_t largestBuffer() const { return largestOf(inputs_); }
  std::uint64_t bytes() const { return bytesOf(inputs_); }
  /// Host memory for frames in flight [bytes].
  std::uint64_t writtenBytes() const { return writtenBytesOf(inputs_); }

  /// Sets the force per kilogram of every particle, groom order [m/s^2], from the next written frame on.
  void set(std::span<const Vec3f> forces);
  /// Writes the frame of a slot.
  void writeFrame(std::size_t slot);
  /// Records the copy to the device with which a frame of this slot begins.
  void record(gpu::CommandList& list, std::size_t slot) const {
    for (const FrameInput& input : inputs_) input.record(list, slot);
  }

 private:
  DeviceForces(bool areThere, std::size_t slots) : areThere_(areThere), isWritten_(slots, false) {}

  bool areThere_;
  std::vector<GroomChunk> chunks_;
  std::vector<FrameInput> inputs_;           // of each chunk
  std::vector<std::uint32_t> groomIndices_;  // of each particle, in device order
  std::vector<layout::vec4> now_;            // in device order
  std::vector<bool> isWritten_;              // of each slot: it has these forces
};

}  // namespace ringlet
