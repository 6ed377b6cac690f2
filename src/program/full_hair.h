// FullHair: hairs that follow strands (FollowPlan), moved on the host, as a groom.
#pragma once

#include <span>
#include <vector>

#include "program/follow_plan.h"
#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"

namespace ringlet::program {

class FullHair {
 public:
  /// As FollowPlan::make.
  static Result<FullHair> make(const Groom& rest, double metresPerUnit, const FollowOptions& options);

  Status checkPose(const Groom& groom) const { return plan_.checkPose(groom); }

  /// Moves the hairs to a pose of the strands, in their unit and order. Cost: with hairs; all cores are used.
  void follow(std::span<const Vec3f> points);

  /// The hairs, in the pose that was followed last, in the strands' unit.
  const Groom& groom() const { return groom_; }

 private:
  explicit FullHair(FollowPlan plan) : plan_(std::move(plan)) {}

  FollowPlan plan_;
  std::vector<std::size_t> firstHair_;  // of each strand, and one more
  Groom groom_;
};

}  // namespace ringlet::program
