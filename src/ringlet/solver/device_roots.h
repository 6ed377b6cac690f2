// DeviceRoots: strands' poses of their own, beside the head's, on a device; nothing where there are none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/strands.h"
#include "ringlet/base/archive.h"
#include "ringlet/base/result.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scene/settings.h"
#include "ringlet/solver/frame_input.h"
#include "ringlet/solver/groom_chunks.h"

namespace ringlet {

/// What carries a strand that has this pose in the head's frame: relative to the head's origin, along world
/// axes.
BodyPose carriedBy(Quatd headRotation, const BodyPose& root);

class DeviceRoots {
 public:
  /// Poses are BodyPose{} at first. `slots`: frames in flight. Fails when the device lacks memory.
  static Result<DeviceRoots> create(gpu::Device& device, const RestState& rest, const Settings& settings,
                                    bool areMoving, std::span<const GroomChunk> chunks, std::size_t slots);

  bool areMoving() const { return areMoving_; }

  /// Of a chunk, as strand kernels bind them.
  gpu::BufferTable bufferTable(std::size_t chunk) const {
    return {{layout::kBindRootPoses, poses_[chunk].seen()},
            {layout::kBindRootPoseTexels, poses_[chunk].seen()}};
  }
  std::uint64_t largestBuffer() const { return largestOf(poses_); }
  std::uint64_t bytes() const { return bytesOf(poses_); }
  /// The host's part, for frames in flight.
  std::uint64_t writtenBytes() const { return writtenBytesOf(poses_); }

  /// Poses of strand s, device order, in the head's frame.
  const BodyPose& now(std::size_t s) const { return now_[s]; }
  const BodyPose& oneStepEarlier(std::size_t s) const { return oneStepEarlier_[s]; }

  /// Steps of another length: roots are as fast and turning as before.
  void setStepSeconds(double seconds);
  /// Before the next step and one step before that, in groom order.
  void place(std::span<const BodyPose> now, std::span<const BodyPose> oneStepEarlier);
  /// Poses of the frame of a slot. heads[0] is the head one step before the frame's start, heads[1] at its
  /// start, heads[2 + k] at the end of step k; `poses` as Simulation::stepFrame takes them, or none: then
  /// they stay.
  void writeFrame(std::size_t slot, std::span<const HeadPose> heads, std::span<const BodyPose> poses);
  /// Whether they stay where they are in a frame, `poses` as above.
  bool areStill(std::span<const BodyPose> poses) const;
  /// A frame of this slot begins with it.
  void record(gpu::CommandList& list, std::size_t slot) const {
    for (const FrameInput& poses : poses_) poses.record(list, slot);
  }
  /// Where roots are now, and were one step earlier.
  void archive(Archive& archive) {
    archive.values(std::span(now_));
    archive.values(std::span(oneStepEarlier_));
  }
  /// A frame that is not stepped: roots are at once where they end, and still there, seen from the head.
  void endFrame(std::span<const BodyPose> poses);

 private:
  DeviceRoots(double stepSeconds, bool areMoving, std::size_t groomStrandCount)
      : stepSeconds_(stepSeconds), areMoving_(areMoving), groomStrandCount_(groomStrandCount) {}
  // Of one step, all strands in groom order, to device order.
  std::vector<BodyPose> inOrder(std::span<const BodyPose> poses) const;

  std::vector<GroomChunk> chunks_;
  std::vector<FrameInput> poses_;  // of each chunk: RootPose[step][strand]
  double stepSeconds_;
  bool areMoving_;
  std::size_t groomStrandCount_;
  std::vector<std::uint32_t> strandInGroom_;
  std::vector<BodyPose> now_, oneStepEarlier_;  // in the head's frame, device order
};

}  // namespace ringlet
