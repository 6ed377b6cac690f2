// FullHair: hairs that follow strands (FollowPlan), as a groom in the strands' present pose.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"
#include "ringlet/output/animation_writer.h"
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

  /// The hairs that FollowPlan::ofScene has, out of the scene's bodies; or none. `makeMover`: needed where
  /// there are any.
  static Result<std::optional<FullHair>> ofScene(const LoadedScene& scene, int hairs, const HairLook& look,
                                                 const FollowMoverMaker& makeMover, const CutList& cuts);

  Status checkPose(const Groom& groom) const { return plan_->checkPose(groom); }

  /// Moves the hairs to a pose of the strands. Errors: those of the mover.
  Status follow(const StrandsPose& pose) { return mover_->move(pose, groom_.points); }
  /// As FollowPlan::rootsAt.
  std::vector<Vec3d> rootsAt(double t, const HeadPose& head) const { return plan_->rootsAt(t, head); }

  /// The hairs in the last pose given to follow, in the strands' unit.
  const Groom& groom() const { return groom_; }
  /// Whether they are a whole groom's own hairs, in its order.
  bool areOwn() const { return !plan_->own().empty(); }
  /// The strand that each hair follows.
  std::vector<std::uint32_t> strandOf() const;
  /// The guides of each, where they are a groom's own that follow strands of it; else none.
  std::vector<ClosestGuides> closestGuides() const;
  /// The hairs' cuts that result from cuts of the strands they follow.
  CutList cutsOfHairs(const CutList& cuts) const;

 private:
  FullHair() = default;
  static Result<FullHair> of(FollowPlan plan, const Groom& rest, const FollowMoverMaker& makeMover,
                             std::span<const Body> bodies);

  std::unique_ptr<FollowPlan> plan_;  // its address must not change: the mover refers to it
  std::unique_ptr<FollowMover> mover_;
  Groom groom_;
};

}  // namespace ringlet
