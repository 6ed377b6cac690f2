// RigidHair: strands that are carried rigidly by their roots and are not on the device
// (rest/rigid_strands.h).
#pragma once

#include <span>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/solver/inputs/frame_input.h"

namespace ringlet {

class RigidHair : public FrameInput {
 public:
  /// Starts with the root poses and shifts of InitialState.
  static Result<RigidHair> create(const InputSource& from);

  std::size_t strandCount() const { return strands_.size(); }

  /// Moves strands by the root poses of a frame's steps; without poses, strands stay on the head.
  void writeFrame(std::size_t slot, const FrameContext& frame) override;
  /// Afterwards roots are at rest relative to the head.
  void jump(const FrameContext& frame) override;
  void rescale(double share) override;
  /// Archives the root poses now and one step earlier.
  Status archive(Archive& archive) override {
    archive.values(std::span(poses_));
    return {};
  }
  gpu::BufferTable bufferTable(std::size_t) const override { return {}; }

  /// Positions relative to the head's origin, along world axes, strand by strand [m].
  std::vector<Vec3f> positions(const HeadPose& now) const;
  /// Velocities relative to the head's translation [m/s].
  std::vector<Vec3f> velocities(const HeadPose& now, const HeadPose& oneStepEarlier,
                                double stepSeconds) const;
  /// Copies values of these strands to their places among all particles, in groom order.
  void scatter(std::span<const Vec3f> values, std::span<Vec3f> inGroomOrder) const;

 private:
  RigidHair(std::vector<RigidStrand> strands, std::size_t groomStrandCount);
  struct Poses {
    BodyPose now, oneStepEarlier;
    Vec3d shift;
  };
  void take(std::span<const BodyPose> ofOneStep);

  std::vector<RigidStrand> strands_;
  std::size_t groomStrandCount_;
  std::vector<Poses> poses_;  // by strand
};

}  // namespace ringlet
