// FrameSlot: a place for a frame in flight: its recorded commands and the host memory for its positions.
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
  std::vector<gpu::Buffer> positions;  // of each chunk at the frame's end, in host memory; or none
  std::vector<Vec3f> rigid{};          // positions of rigid strands at that time, as RigidHair gives them
  gpu::Recorder recorder;              // destroyed first: it waits for the commands that write the others
  enum class Recorded { nothing, frame, sleep };
  Recorded recorded = Recorded::nothing;  // sleep: a frame without steps
  double particleSteps = 0;               // of strands, in what is recorded
  bool isHosts = false;  // the frame is in a host's commands (hair_frames.h), which tell when it is over

  /// Fails when the device lacks memory.
  static Result<FrameSlot> create(gpu::Device& device, const DeviceGroom& groom, bool readsBack);

  /// Records the read-back of positions at the frame's end, if they are read back.
  void recordPositions(gpu::CommandList& list, const DeviceGroom& groom) const;
  /// Reads positions back now, after a frame that is not recorded.
  Status downloadPositions(const DeviceGroom& groom);
  /// Writes the positions at the frame's end of the strands here to where they are in the groom.
  void scatter(const RestState& rest, const DeviceGroom& groom, const RigidHair& rigidHair,
               std::span<Vec3f> inGroomOrder) const;
  /// The positions read back, by chunk, in device order; empty if they are not read back.
  std::vector<std::span<const layout::vec4>> readPositions() const;
  std::uint64_t bytes() const;
};

}  // namespace ringlet
