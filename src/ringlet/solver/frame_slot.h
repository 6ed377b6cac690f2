// FrameSlot: a place for a frame in flight: its recording, and where its positions come back to.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "layout/types.h"
#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/recorder.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/solver/device_groom.h"
#include "ringlet/solver/rigid_hair.h"

namespace ringlet {

struct FrameSlot {
  std::vector<gpu::Buffer> positions;  // of each chunk, as the frame left them, in the host's memory; or none
  std::vector<Vec3f> rigid{};          // positions of rigid strands then, as RigidHair gives them
  gpu::Recorder recorder;              // goes first, waiting for what it writes
  enum class Recorded { nothing, frame, sleep };
  Recorded recorded = Recorded::nothing;  // sleep: a frame without steps
  double particleSteps = 0;               // of strands, in what is recorded
  bool isHosts = false;  // the frame is in others' commands (hair_frames.h): they say when it is over

  /// Fails when the device lacks memory.
  static Result<FrameSlot> create(gpu::Device& device, const DeviceGroom& groom, bool readsBack);

  /// Brings positions back, at the frame's end, where they are to come back.
  void recordPositions(gpu::CommandList& list, const DeviceGroom& groom) const;
  /// Brings them back now, after a frame that is not recorded.
  Status downloadPositions(const DeviceGroom& groom);
  std::vector<Vec3f> inGroomOrder(const RestState& rest, const DeviceGroom& groom,
                                  const RigidHair& rigidHair) const;
  /// As they came back, chunk by chunk, in device order; none where they do not.
  std::vector<std::span<const layout::vec4>> readPositions() const;
  std::uint64_t bytes() const;
};

}  // namespace ringlet
