// FullHair: the many hairs that follow the strands of an animation, or of one groom.
#pragma once

#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/follow/follow_hairs.h"
#include "ringlet/groom/groom.h"

namespace ringlet::program {

class FullHair {
 public:
  /// `rest`: the strands as they were groomed, in units of `metresPerUnit`. Errors: the options'; a strand
  /// that cannot be followed, as it has no length.
  static Result<FullHair> make(const Groom& rest, double metresPerUnit, const FollowOptions& options);

  /// Whether `groom` can be a pose of those strands: as many, with as many particles, not of another scale.
  Status checkPose(const Groom& groom) const;

  /// Moves the hairs to a pose of the strands, in their unit and order. How the head has turned is taken from
  /// the roots. Cost: with hairs; all cores are used.
  void follow(std::span<const Vec3f> points);

  /// The hairs, in the pose that was followed last, in the strands' unit.
  const Groom& groom() const { return groom_; }

 private:
  std::vector<Vec3d> strandAt(std::span<const Vec3f> points, std::size_t strand) const;

  double metresPerUnit_ = 0.01;
  std::vector<std::uint32_t> firstPoint_;  // of strands
  std::vector<GuideRest> guides_;
  std::vector<FollowHair> hairs_;
  std::vector<std::size_t> firstHair_;  // of each strand, and one more
  Groom groom_;
};

}  // namespace ringlet::program
