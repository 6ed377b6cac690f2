// FullHair: hairs that follow strands (FollowPlan), as a groom that is moved.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"
#include "ringlet/pictures/follow_mover.h"
#include "ringlet/pictures/follow_plan.h"
#include "ringlet/scene/body.h"
#include "ringlet/scenes/frames/cut_list.h"

namespace ringlet {

class FullHair {
 public:
  /// As FollowPlan::make. `bodies`: that hairs stay out of where their strands do.
  static Result<FullHair> make(const Groom& rest, double metresPerUnit, const FollowOptions& options,
                               const FollowMoverMaker& makeMover, std::span<const Body> bodies = {},
                               const HairGround& ground = {}, const CutList& cuts = {});

  Status checkPose(const Groom& groom) const { return plan_->checkPose(groom); }

  /// Moves the hairs to a pose of the strands. Errors: those of the mover.
  Status follow(const StrandsPose& pose) { return mover_->move(pose, groom_.points); }
  /// As FollowPlan::rootsAt.
  std::vector<Vec3d> rootsAt(double t, const HeadPose& head) const { return plan_->rootsAt(t, head); }

  /// The hairs, in the pose that was followed last, in the strands' unit.
  const Groom& groom() const { return groom_; }
  /// Of each hair, the strand that it follows.
  std::vector<std::uint32_t> strandOf() const;
  /// Where hairs are cut as the strands are cut that they follow.
  CutList cutsOfHairs(const CutList& cuts) const;

 private:
  FullHair() = default;

  std::unique_ptr<FollowPlan> plan_;  // stays where it is: the mover refers to it
  std::unique_ptr<FollowMover> mover_;
  Groom groom_;
};

}  // namespace ringlet
