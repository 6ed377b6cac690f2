// RigidHair: the strands that their roots carry rigidly; they are not on the device (rest/rigid_strands.h).
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
  /// Of these strands, at first without root poses and shifts.
  RigidHair(std::vector<RigidStrand> strands, std::size_t groomStrandCount);

  std::size_t strandCount() const { return strands_.size(); }

  /// Sets shifts as in InitialState.
  void setRootShifts(std::span<const Vec3d> shifts);
  /// Sets root poses before the next step and one step earlier, of all strands in groom order.
  void placeRoots(std::span<const BodyPose> now, std::span<const BodyPose> oneStepEarlier);
  /// Moves by the poses of a frame's steps, as Simulation::stepFrame takes them; without any, strands stay.
  void endFrame(std::span<const BodyPose> poses);
  /// The same of a frame that is not stepped: afterwards roots are at rest relative to the head.
  void jump(std::span<const BodyPose> poses);

  /// Adapts to steps that are this share as long: the velocities of the roots stay.
  void rescale(double share) {
    for (Poses& p : poses_) p.oneStepEarlier = interpolate(p.now, p.oneStepEarlier, share);
  }
  /// The root poses now and one step earlier.
  void archive(Archive& archive) { archive.values(std::span(poses_)); }

  /// Positions relative to the head's origin, along world axes, strand by strand [m].
  std::vector<Vec3f> positions(const HeadPose& now) const;
  /// Velocities relative to the head's translation [m/s].
  std::vector<Vec3f> velocities(const HeadPose& now, const HeadPose& oneStepEarlier,
                                double stepSeconds) const;
  /// Copies such values to the places of these strands among all particles, in groom order.
  void scatter(std::span<const Vec3f> values, std::span<Vec3f> inGroomOrder) const;

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
