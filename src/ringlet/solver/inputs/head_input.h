// HeadInput: the poses of the head, from step to step.
#pragma once

#include "ringlet/scene/head_pose.h"
#include "ringlet/solver/inputs/frame_input.h"

namespace ringlet {

/// The head's pose now and one outer step earlier.
struct HeadHistory {
  HeadPose oneStepEarlier, now;

  /// Adapts to a step length multiplied by this share; the velocity stays.
  void rescale(double share) { oneStepEarlier = interpolate(now, oneStepEarlier, share); }

  Vec3d velocity(double T) const { return (now.position - oneStepEarlier.position) / T; }
  Quatd turn() const { return now.rotation * oneStepEarlier.rotation.conjugate(); }
  /// Moves to another pose; the velocity in the head's own axes stays.
  void jump(const HeadPose& to);
};

class HeadInput : public FrameInput {
 public:
  static Result<HeadInput> create(const InputSource& from);

  const HeadHistory& history() const { return history_; }
  const HeadPose& now() const { return history_.now; }
  const gpu::Buffer& poses() const { return staged_[0].seen(); }

  void writeFrame(std::size_t slot, const FrameContext& frame) override;
  void jump(const FrameContext& frame) override { history_.jump(frame.end()); }
  bool isQuiet(const FrameContext& frame) const override;
  void rescale(double share) override { history_.rescale(share); }
  Status archive(Archive& archive) override {
    archive.value(history_);
    return {};
  }
  gpu::BufferTable bufferTable(std::size_t chunk) const override;

 private:
  HeadHistory history_;
};

}  // namespace ringlet
