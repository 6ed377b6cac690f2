// FullHair: hairs that follow strands (FollowPlan), moved on the host, as a groom.
#pragma once

#include <span>
#include <vector>

#include "program/follow_plan.h"
#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"
#include "ringlet/scene/body.h"

namespace ringlet::program {

class FullHair {
 public:
  /// As FollowPlan::make. `bodies`: that hairs stay out of where their strands do.
  static Result<FullHair> make(const Groom& rest, double metresPerUnit, const FollowOptions& options,
                               std::span<const Body> bodies = {}, const HairGround& ground = {},
                               const CutList& cuts = {});

  Status checkPose(const Groom& groom) const { return plan_.checkPose(groom); }

  /// Moves the hairs to a pose of the strands, in their unit and order; `bodies`: one pose a body, or none,
  /// as if there were no bodies; `roots`: of rootsAt. Cost: with hairs; all cores are used.
  void follow(std::span<const Vec3f> points, std::span<const BodyPose> bodies = {},
              std::span<const Vec3d> roots = {});
  /// As FollowPlan::rootsAt.
  std::vector<Vec3d> rootsAt(double t, const HeadPose& head) const { return plan_.rootsAt(t, head); }

  /// The hairs, in the pose that was followed last, in the strands' unit.
  const Groom& groom() const { return groom_; }
  /// Of each hair, the strand that it follows.
  std::vector<std::uint32_t> strandOf() const;
  /// Where hairs are cut as the strands are cut that they follow.
  CutList cutsOfHairs(const CutList& cuts) const;

 private:
  FullHair(FollowPlan plan, std::span<const Body> bodies)
      : plan_(std::move(plan)), bodies_(bodies.begin(), bodies.end()) {}

  FollowPlan plan_;
  std::vector<Body> bodies_;
  std::vector<std::size_t> firstHair_;  // of each strand, and one more
  bool isBlended_ = false;              // hairs follow several strands
  Groom groom_;
};

}  // namespace ringlet::program
