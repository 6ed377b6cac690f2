// DeviceForces: forces from outside on the particles of one head; nothing where its hair was built without.
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
#include "ringlet/solver/frame_input.h"
#include "ringlet/solver/groom_chunks.h"

namespace ringlet {

class DeviceForces {
 public:
  /// None act at first. `slots`: frames in flight. Fails when the device lacks memory.
  static Result<DeviceForces> create(gpu::Device& device, const RestState& rest, bool areThere,
                                     std::span<const GroomChunk> chunks, std::size_t slots);

  bool areThere() const { return areThere_; }

  /// Of a chunk, as strand kernels bind them.
  gpu::BufferTable bufferTable(std::size_t chunk) const {
    return {{layout::kBindOutsideForces, inputs_[chunk].seen()},
            {layout::kBindOutsideForceTexels, inputs_[chunk].seen()}};
  }
  std::uint64_t largestBuffer() const { return largestOf(inputs_); }
  std::uint64_t bytes() const { return bytesOf(inputs_); }
  /// The host's part, for frames in flight.
  std::uint64_t writtenBytes() const { return writtenBytesOf(inputs_); }

  /// On each kilogram of every particle, groom order [m/s^2], from the next frame written on.
  void set(std::span<const Vec3f> forces);
  /// For the frame of a slot.
  void writeFrame(std::size_t slot);
  /// A frame of this slot begins with it.
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
  std::vector<bool> isWritten_;              // whether a slot has these
};

}  // namespace ringlet
