// DeviceGoals: places that the particles of one head are pulled to; empty if the hair was built without.
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
#include "ringlet/rest/goal_units.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/solver/inputs/frame_input.h"
#include "ringlet/solver/plan/groom_chunks.h"

namespace ringlet {

class DeviceGoals {
 public:
  /// All strengths are 0 at first. `units`: goalUnits, which must outlive this, or null for hair without
  /// goals. `slots`: frames in flight. Fails when the device lacks memory.
  static Result<DeviceGoals> create(gpu::Device& device, const RestState& rest,
                                    const std::vector<GoalUnit>* units, std::span<const GroomChunk> chunks,
                                    std::size_t slots);

  bool areThere() const { return units_ != nullptr; }

  /// Bindings of the strand kernels, of a chunk.
  gpu::BufferTable bufferTable(std::size_t chunk) const {
    return {{layout::kBindGoalsBefore, before_[chunk].seen()},
            {layout::kBindGoals, after_[chunk].seen()},
            {layout::kBindGoalBeforeTexels, before_[chunk].seen()},
            {layout::kBindGoalTexels, after_[chunk].seen()}};
  }
  std::uint64_t largestBuffer() const { return largestOf(after_); }
  std::uint64_t bytes() const { return bytesOf(before_) + bytesOf(after_); }
  /// Host memory for frames in flight [bytes].
  std::uint64_t writtenBytes() const { return writtenBytesOf(before_) + writtenBytesOf(after_); }

  /// As Simulation::setGoals: the goals at the end of the next written frame, and from then on.
  void set(std::span<const Vec3f> places, std::span<const float> strengths, double dampingRatio,
           std::span<const Vec3f> from);
  /// Writes the frame of a slot.
  void writeFrame(std::size_t slot);
  /// Records the copy to the device with which a frame of this slot begins.
  void record(gpu::CommandList& list, std::size_t slot) const {
    for (const auto* inputs : {&before_, &after_})
      for (const FrameInput& input : *inputs) input.record(list, slot);
  }

 private:
  DeviceGoals(const std::vector<GoalUnit>* units, std::size_t slots)
      : units_(units), isWritten_(slots, false) {}

  bool areSet_ = false;
  std::vector<GroomChunk> chunks_;
  std::vector<FrameInput> before_, after_;   // of each chunk: vec4[particles]
  std::vector<std::uint32_t> groomIndices_;  // of each particle, in device order
  const std::vector<GoalUnit>* units_;       // of each particle, in device order
  std::vector<layout::vec4> start_, end_;    // of the next frame, in device order
  bool move_ = false;                        // goals move in the next frame
  std::vector<bool> isWritten_;              // of each slot: it has these goals
};

}  // namespace ringlet
