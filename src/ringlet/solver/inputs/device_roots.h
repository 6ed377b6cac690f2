// DeviceRoots: the poses of the strands' roots, in the head's frame, on a device; empty if strands have none.
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
#include "ringlet/solver/inputs/frame_input.h"
#include "ringlet/solver/plan/groom_chunks.h"

namespace ringlet {

/// The pose that carries a strand whose root has this pose in the head's frame: relative to the head's
/// origin, along world axes.
BodyPose carriedBy(Quatd headRotation, const BodyPose& root);

class DeviceRoots {
 public:
  /// All poses are BodyPose{} at first. `slots`: frames in flight. Fails if the device lacks memory.
  static Result<DeviceRoots> create(gpu::Device& device, const RestState& rest, const Settings& settings,
                                    bool areMoving, std::span<const GroomChunk> chunks, std::size_t slots);

  bool areMoving() const { return areMoving_; }

  /// Bindings of the strand kernels, of a chunk.
  gpu::BufferTable bufferTable(std::size_t chunk) const {
    return {{layout::kBindRootPoses, poses_[chunk].seen()},
            {layout::kBindRootPoseTexels, poses_[chunk].seen()}};
  }
  std::uint64_t largestBuffer() const { return largestOf(poses_); }
  std::uint64_t bytes() const { return bytesOf(poses_); }
  /// Host memory for frames in flight [bytes].
  std::uint64_t writtenBytes() const { return writtenBytesOf(poses_); }

  /// Poses of strand s, device order, in the head's frame.
  const BodyPose& now(std::size_t s) const { return now_[s]; }
  const BodyPose& oneStepEarlier(std::size_t s) const { return oneStepEarlier_[s]; }

  /// Adapts to another step length: the velocities of the roots stay.
  void setStepSeconds(double seconds);
  /// Sets the poses before the next step and one step earlier, in groom order.
  void place(std::span<const BodyPose> now, std::span<const BodyPose> oneStepEarlier);
  /// Writes the poses of the frame of a slot. heads[0] is the head one step before the frame's start,
  /// heads[1] at its start, heads[2 + k] at the end of step k; `poses` as Simulation::stepFrame takes them;
  /// without any they stay.
  void writeFrame(std::size_t slot, std::span<const HeadPose> heads, std::span<const BodyPose> poses);
  /// Whether all roots stay at rest in a frame, `poses` as above.
  bool areStill(std::span<const BodyPose> poses) const;
  /// Records the copy to the device with which a frame of this slot begins.
  void record(gpu::CommandList& list, std::size_t slot) const {
    for (const FrameInput& poses : poses_) poses.record(list, slot);
  }
  /// The poses now and one step earlier.
  void archive(Archive& archive) {
    archive.values(std::span(now_));
    archive.values(std::span(oneStepEarlier_));
  }
  /// Ends a frame that is not stepped: roots are at their last poses, at rest relative to the head.
  void endFrame(std::span<const BodyPose> poses);

 private:
  DeviceRoots(double stepSeconds, bool areMoving, std::size_t groomStrandCount)
      : stepSeconds_(stepSeconds), areMoving_(areMoving), groomStrandCount_(groomStrandCount) {}
  // Reorders the poses of one step from groom order to device order.
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
