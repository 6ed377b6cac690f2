// FollowPlan: the many hairs that follow the strands of an animation: which, beside which strand, and what a
// frame's poses are. FullHair (on the host) and pictures (on a device) move them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/follow/follow_hairs.h"
#include "ringlet/groom/groom.h"
#include "ringlet/motion/head_scalp.h"
#include "ringlet/pictures/hair_ground.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scenes/frames/cut_list.h"

namespace ringlet {

class FollowPlan {
 public:
  /// `rest`: the strands as they were groomed, in units of `metresPerUnit`. Errors: the options' and the
  /// ground's; a strand that cannot be followed, as it has no length; hairs of more points than can be
  /// numbered.
  /// `cuts`: of the strands.
  static Result<FollowPlan> make(const Groom& rest, double metresPerUnit, const FollowOptions& options,
                                 const HairGround& ground = {}, const CutList& cuts = {});

  /// Whether `groom` can be a pose of those strands: as many, with as many particles, not of another scale.
  Status checkPose(const Groom& groom) const;

  /// How the head has turned in a pose of the strands, taken from the roots.
  Quatd headOf(std::span<const Vec3f> points) const;
  /// The particles of a strand in a pose [m].
  std::vector<Vec3d> strandOf(std::span<const Vec3f> points, std::size_t strand) const;

  /// Whether a scalp carries the hairs' roots, not the head.
  bool isOnScalp() const { return scalp_.has_value(); }
  const std::vector<Vec3d>& restRoots() const { return roots_; }  // on a scalp, in the groom [m]; else none
  /// The hairs' roots in the world, t seconds after the start with the head there [m]; none on no scalp.
  std::vector<Vec3d> rootsAt(double t, const HeadPose& head) const;

  const std::vector<GuideRest>& guides() const { return guides_; }  // one a strand
  const std::vector<FollowHair>& hairs() const { return hairs_; }   // those of a strand one after the other
  /// Of all hairs' points, of each hair, and one more.
  const std::vector<std::uint32_t>& firstPoint() const { return firstHairPoint_; }
  double metresPerUnit() const { return metresPerUnit_; }

 private:
  Status plant(const FollowOptions& options, const HairGround& ground);

  double metresPerUnit_ = 0.01;
  std::vector<std::uint32_t> firstPoint_;  // of strands
  std::vector<GuideRest> guides_;
  std::vector<FollowHair> hairs_;
  std::optional<HeadScalp> scalp_;  // to which the hairs' roots are bound
  std::vector<Vec3d> roots_;        // these at rest [m]
  std::vector<std::uint32_t> firstHairPoint_;
};

}  // namespace ringlet
