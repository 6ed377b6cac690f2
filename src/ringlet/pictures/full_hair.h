// FullHair: hairs that follow strands (FollowPlan), as a groom in the strands' present pose.
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
  /// As FollowPlan::make. `bodies`: hairs are kept out of them as far as their strands are.
  static Result<FullHair> make(const Groom& rest, double metresPerUnit, const FollowOptions& options,
                               const FollowMoverMaker& makeMover, std::span<const Body> bodies = {},
                               const HairGround& ground = {}, const CutList& cuts = {});

  Status checkPose(const Groom& groom) const { return plan_->checkPose(groom); }

  /// Moves the hairs to a pose of the strands. Errors: those of the mover.
  Status follow(const StrandsPose& pose) { return mover_->move(pose, groom_.points); }
  /// As FollowPlan::rootsAt.
  std::vector<Vec3d> rootsAt(double t, const HeadPose& head) const { return plan_->rootsAt(t, head); }

  /// The hairs in the last pose given to follow, in the strands' unit.
  const Groom& groom() const { return groom_; }
  /// The strand that each hair follows.
  std::vector<std::uint32_t> strandOf() const;
  /// The hairs' cuts that result from cuts of the strands they follow.
  CutList cutsOfHairs(const CutList& cuts) const;

 private:
  FullHair() = default;

  std::unique_ptr<FollowPlan> plan_;  // its address must not change: the mover refers to it
  std::unique_ptr<FollowMover> mover_;
  Groom groom_;
};

}  // namespace ringlet
