// FollowPlan: the many hairs that follow the strands of an animation: which, beside which strand, and what a
// frame's poses are. FullHair (on the host) and pictures (on a device) move them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/follow/follow_hairs.h"
#include "ringlet/groom/groom.h"

namespace ringlet::program {

class FollowPlan {
 public:
  /// `rest`: the strands as they were groomed, in units of `metresPerUnit`. Errors: the options'; a strand
  /// that cannot be followed, as it has no length; hairs of more points than can be numbered.
  static Result<FollowPlan> make(const Groom& rest, double metresPerUnit, const FollowOptions& options);

  /// Whether `groom` can be a pose of those strands: as many, with as many particles, not of another scale.
  Status checkPose(const Groom& groom) const;

  /// How the head has turned in a pose of the strands, taken from the roots.
  Quatd headOf(std::span<const Vec3f> points) const;
  /// The particles of a strand in a pose [m].
  std::vector<Vec3d> strandOf(std::span<const Vec3f> points, std::size_t strand) const;

  const std::vector<GuideRest>& guides() const { return guides_; }  // one a strand
  const std::vector<FollowHair>& hairs() const { return hairs_; }   // those of a strand one after the other
  /// Of all hairs' points, of each hair, and one more.
  const std::vector<std::uint32_t>& firstPoint() const { return firstHairPoint_; }
  double metresPerUnit() const { return metresPerUnit_; }

 private:
  double metresPerUnit_ = 0.01;
  std::vector<std::uint32_t> firstPoint_;  // of strands
  std::vector<GuideRest> guides_;
  std::vector<FollowHair> hairs_;
  std::vector<std::uint32_t> firstHairPoint_;
};

}  // namespace ringlet::program
