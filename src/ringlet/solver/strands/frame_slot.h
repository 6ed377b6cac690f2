// FrameSlot: the commands of a frame in flight and the host memory for its positions.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/recorder.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/solver/inputs/bending_bodies.h"
#include "ringlet/solver/inputs/rigid_hair.h"
#include "ringlet/solver/strands/device_groom.h"
#include "ringlet/solver/strands/frame_readback.h"

namespace ringlet {

struct FrameSlot {
  std::optional<FrameReadback> readback{};  // of the frame's end, if positions are read back
  std::vector<Vec3f> rigid{};  // positions of rigid strands at that time, as RigidHair gives them
  gpu::Recorder recorder;      // destroyed first: it waits for the commands that write the others
  enum class Recorded { nothing, frame, sleep };
  Recorded recorded = Recorded::nothing;  // sleep: a frame without steps
  std::uint32_t untilSort = 0;            // VolumeStage::untilSort of the recording
  BendingBodies::Work fieldWork{};        // BodiesInput::fieldWork of the recording
  double particleSteps = 0;               // of strands, in the recording
  bool isHosts = false;  // the frame is in a host's commands (hair_frames.h); the host says when it is over

  /// Fails when the device lacks memory.
  static Result<FrameSlot> create(gpu::Device& device, const DeviceGroom& groom, const FramePlaces& places,
                                  std::uint64_t mostBufferBytes, bool readsBack);

  /// Records the read-back of positions at the frame's end, if they are read back.
  void recordPositions(gpu::CommandList& list) const;
  /// Call it once the device has done the frame.
  void arrive(const FramePlaces& places) {
    if (readback) readback->arrive(places);
  }
  /// Reads positions back now, after a frame that is not recorded.
  Status downloadPositions(const FramePlaces& places);
  /// The positions read back, by place, without rigid strands; empty if positions are not read back.
  std::span<const Vec3f> positions() const {
    return readback ? std::span<const Vec3f>(readback->positions()) : std::span<const Vec3f>();
  }
  /// Copies the positions of the strands here to their places in groom order.
  void copyPositions(const RestState& rest, const FramePlaces& places, const RigidHair& rigidHair,
                     std::span<Vec3f> inGroomOrder) const;
  /// All positions in groom order, without a copy; only if the device steps the whole groom.
  std::span<const Vec3f> viewPositions(const RigidHair& rigidHair) const;
  std::uint64_t bytes() const { return readback ? readback->bytes() : 0; }
};

}  // namespace ringlet
