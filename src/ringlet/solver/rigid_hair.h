// RigidHair: the strands that are carried by their roots and never on the device (rest/rigid_strands.h).
#pragma once

#include <span>
#include <vector>

#include "ringlet/base/archive.h"
#include "ringlet/base/vec3.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/head_pose.h"

namespace ringlet {

class RigidHair {
 public:
  /// Takes the strands. They have no poses of their own and no shifts at first.
  RigidHair(std::vector<RigidStrand> strands, std::size_t groomStrandCount);

  std::size_t strandCount() const { return strands_.size(); }

  /// As InitialState has them.
  void setRootShifts(std::span<const Vec3d> shifts);
  /// Strands' own poses before the next step and one step before that, of all strands in groom order.
  void placeRoots(std::span<const BodyPose> now, std::span<const BodyPose> oneStepEarlier);
  /// Poses of a frame's steps as Simulation::stepFrame takes them, or none: then they stay.
  void endFrame(std::span<const BodyPose> poses);
  /// The same of a frame that is not stepped: roots are still, seen from the head.
  void jump(std::span<const BodyPose> poses);

  /// Steps are now this share as long: roots are as fast and turning as before.
  void rescale(double share) {
    for (Poses& p : poses_) p.oneStepEarlier = interpolate(p.now, p.oneStepEarlier, share);
  }
  /// Where roots are now, and were one step earlier.
  void archive(Archive& archive) { archive.values(std::span(poses_)); }

  /// Relative to the head's origin, along world axes, strand after strand [m].
  std::vector<Vec3f> positions(const HeadPose& now) const;
  /// And relative to its translation [m/s].
  std::vector<Vec3f> velocities(const HeadPose& now, const HeadPose& oneStepEarlier,
                                double stepSeconds) const;
  /// Puts such values where the strands are among those of all particles, in groom order.
  void scatter(std::span<const Vec3f> values, std::vector<Vec3f>& inGroomOrder) const;

 private:
  struct Poses {
    BodyPose now, oneStepEarlier;
    Vec3d shift;
  };
  void take(std::span<const BodyPose> ofOneStep);

  std::vector<RigidStrand> strands_;
  std::size_t groomStrandCount_;
  std::vector<Poses> poses_;  // of each
};

}  // namespace ringlet
