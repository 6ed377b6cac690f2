// RootsInput: the poses of the strands' roots, in the head's frame; empty if strands have none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/strands.h"
#include "ringlet/scene/body.h"
#include "ringlet/solver/inputs/frame_input.h"
#include "ringlet/solver/plan/groom_chunks.h"

namespace ringlet {

/// The transform of a strand whose root has pose `root` in the head's frame: relative to the head's origin,
/// along world axes.
BodyPose carriedBy(Quatd headRotation, const BodyPose& root);

class RootsInput : public FrameInput {
 public:
  /// Starts with the poses of InitialState, or BodyPose{}. Fails when the device lacks memory.
  static Result<RootsInput> create(const InputSource& from);

  bool areMoving() const { return areMoving_; }
  /// Poses of strand s, device order, in the head's frame.
  const BodyPose& now(std::size_t s) const { return now_[s]; }
  const BodyPose& oneStepEarlier(std::size_t s) const { return oneStepEarlier_[s]; }

  Status prepare(const InputSource& from) override;
  void writeFrame(std::size_t slot, const FrameContext& frame) override;
  void jump(const FrameContext& frame) override;
  bool isQuiet(const FrameContext& frame) const override;
  void rescale(double share) override;
  Status archive(Archive& archive) override;
  gpu::BufferTable bufferTable(std::size_t chunk) const override;

 private:
  std::uint64_t DeviceMemory::*kind() const override;
  RootsInput() = default;
  // Reorders the poses of one step from groom order to device order.
  std::vector<BodyPose> inOrder(std::span<const BodyPose> poses) const;

  // Staged, of each chunk: RootPose[1 + step][strand].
  std::span<const GroomChunk> chunks_;
  bool areMoving_ = false;
  std::size_t groomStrandCount_ = 0;
  std::vector<std::uint32_t> strandInGroom_;
  std::vector<BodyPose> now_, oneStepEarlier_;  // in the head's frame, device order
};

}  // namespace ringlet
