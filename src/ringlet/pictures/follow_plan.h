// FollowPlan: the many hairs that follow the strands of an animation, planned beside them or a groom's own:
// which strand each follows, and where beside it; and the poses of a frame. FullHair (on the host) and
// pictures (on a device) move them.
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
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

class FollowPlan {
 public:
  /// `rest`: the strands as groomed, in units of `metresPerUnit`. `cuts`: of the strands. Errors: those of
  /// the options and of the ground; a strand that cannot be followed, since it has no length; more points of
  /// hairs than can be numbered.
  static Result<FollowPlan> make(const Groom& rest, double metresPerUnit, const FollowOptions& options,
                                 const HairGround& ground = {}, const CutList& cuts = {});

  /// The hairs that are shown of a scene in place of its strands: `hairs` planned beside them; at 0 those of
  /// its groom, where they follow guides; else none. Errors: as above; a root of the groom off the scalp.
  static Result<std::optional<FollowPlan>> ofScene(const LoadedScene& scene, int hairs, const HairLook& look,
                                                   const CutList& cuts);

  /// Whether `groom` can be a pose of the strands: as many of them, with as many particles, at the same
  /// scale.
  Status checkPose(const Groom& groom) const;

  /// The rotation of the head in a pose of the strands, estimated from the roots.
  Quatd headOf(std::span<const Vec3f> points) const;
  /// The particles of a strand in a pose [m].
  std::vector<Vec3d> strandOf(std::span<const Vec3f> points, std::size_t strand) const;

  /// Whether a scalp carries the hairs' roots, and not the head.
  bool isOnScalp() const { return scalp_.has_value(); }
  const std::vector<Vec3d>& restRoots() const { return roots_; }  // on a scalp, in the groom [m]; else empty
  /// The hairs' roots in the world, t seconds after the start, with the head at `head` [m]; empty without a
  /// scalp.
  std::vector<Vec3d> rootsAt(double t, const HeadPose& head) const;

  const std::vector<GuideRest>& guides() const { return guides_; }  // one per strand
  const std::vector<FollowHair>& hairs() const { return hairs_; }
  /// The groom's strands that its own hairs follow; none: they follow a file's.
  const std::vector<std::uint32_t>& guideStrands() const { return guideStrands_; }
  const OwnPoints& own() const { return own_; }  // of a whole groom's hairs, else empty
  /// Index of each hair's first point among all points, and at the end their number.
  const std::vector<std::uint32_t>& firstPoint() const { return firstHairPoint_; }
  double metresPerUnit() const { return metresPerUnit_; }

 private:
  static Result<FollowPlan> ofGroom(const LoadedScene& scene);
  Status takeStrands(const Groom& rest, double metresPerUnit, const CutList& cuts);
  Status plant(const FollowOptions& options, const HairGround& ground);
  Status numberPoints();

  double metresPerUnit_ = 0.01;
  std::vector<std::uint32_t> firstPoint_;  // of strands
  std::vector<GuideRest> guides_;
  std::vector<FollowHair> hairs_;
  OwnPoints own_;
  std::vector<std::uint32_t> guideStrands_;
  std::optional<HeadScalp> scalp_;  // the hairs' roots are bound to it
  std::vector<Vec3d> roots_;        // the hairs' roots at rest [m]
  std::vector<std::uint32_t> firstHairPoint_;
};

}  // namespace ringlet
