// PictureHair: what is drawn for an animation's strands, on the device: hairs that follow them, or the
// strands themselves.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/follow/follow_stage.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/groom/groom.h"
#include "ringlet/pictures/follow_mover.h"
#include "ringlet/pictures/follow_plan.h"
#include "ringlet/pictures/hair_look.h"
#include "ringlet/render/strand_points.h"
#include "ringlet/solver/compute_device.h"

namespace ringlet {

/// The user's choices. What is left open is chosen by the number of strands.
struct PictureHairChoice {
  std::optional<int> hairs;     // number of following hairs; 0: the strands themselves
  std::optional<double> width;  // diameter at the root [m]
  HairLook look;                // of following hairs
};

/// What a scene has for hairs that follow.
struct PictureHairScene {
  std::span<const Body> bodies{};  // that they stay out of
  HairGround ground{};
  CutList cuts{};  // of the strands
};

class PictureHair {
 public:
  /// `rest`: the strands as they were groomed, in units of `metresPerUnit`; `first`: frame 1 of them. Errors:
  /// the two do not belong together; the device has too little memory.
  static Result<PictureHair> create(const ComputeDevice& device, const Groom& rest, const Groom& first,
                                    double metresPerUnit, const PictureHairChoice& choice,
                                    const PictureHairScene& scene = {});

  /// Sets the next pose; cuts of strands up to `frame` are applied. The device must be idle.
  Status setPose(const StrandsPose& pose, int frame = 1);
  /// As FollowPlan::rootsAt.
  std::vector<Vec3d> rootsAt(double t, const HeadPose& head) const {
    return plan_ ? plan_->rootsAt(t, head) : std::vector<Vec3d>();
  }
  /// The rotation of the head relative to the rest pose.
  Quatd headOf(std::span<const Vec3f> points) const;
  /// Records moving the following hairs to the pose; the stage is called "follow".
  void record(gpu::CommandList& list, Quatd head);

  const gpu::Buffer& points() const { return hairs_ ? hairs_->points() : lines_->points(); }
  const std::vector<std::uint32_t>& firstPoint() const {
    return hairs_ ? hairs_->firstPoint() : lines_->firstPoint();
  }
  /// The strands' points [m]: x, y, z and an unused number.
  const gpu::Buffer& strandPoints() const { return hairs_ ? hairs_->pose() : lines_->points(); }
  /// The strand that each hair follows or is.
  std::vector<std::uint32_t> strandOf() const;
  const std::vector<Vec3d>& restRoots() const { return restRoots_; }  // [m]
  std::vector<Vec3d> rootsOf(std::span<const Vec3f> points) const;    // [m]

  std::size_t strandCount() const { return firstOfStrand_.size() - 1; }
  std::size_t hairCount() const { return firstPoint().size() - 1; }
  double width() const { return width_; }  // [m]
  bool follows() const { return hairs_.has_value(); }
  std::uint64_t byteCount() const { return hairs_ ? hairs_->byteCount() : lines_->points().bytes(); }

 private:
  PictureHair() = default;

  double metresPerUnit_ = 0.01, width_ = 0;
  std::vector<std::uint32_t> firstOfStrand_;
  std::vector<Vec3d> restRoots_;
  CutList cuts_;
  std::optional<FollowPlan> plan_;
  std::optional<FollowStage> hairs_;  // either this or lines_
  std::optional<StrandPoints> lines_;
};

}  // namespace ringlet
