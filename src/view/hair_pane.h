// HairPane: one hair in one part of the window: its points go from the solver to what draws them without
// leaving the device.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/follow/device_pose.h"
#include "ringlet/follow/follow_stage.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/pictures/follow_plan.h"
#include "ringlet/render/hair_renderer.h"
#include "ringlet/render/strand_points.h"
#include "ringlet/render/stretch_colours.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scenes/load/load_scene.h"
#include "ringlet/solver/simulation.h"

namespace ringlet::view {

/// Strands stand for locks where no hairs follow them; they are not drawn wider [m].
inline constexpr double kMostStrandWidth = 0.0012;

/// What is drawn beside the numbers of a session.
struct PaneLook {
  std::shared_ptr<const FollowPlan> follow;  // the hairs that follow the strands; none: these are drawn
  std::vector<Body> bodies;                  // that hairs stay out of
  std::vector<SolidMesh> solids;
  PictureSize size;
  bool showsStretch = false;  // in place of the look's colour
  Look look;
  double width = 0.001;  // of hairs at the root [m]
};

/// What hairs that follow have about them.
struct HairSurroundings {
  std::span<const BodyPose> bodies{};                // one pose a body
  std::span<const std::vector<Vec3d>> bodyPoints{};  // Session::bodyPoints
  std::span<const Vec3d> roots{};                    // of hairs on a scalp (FollowPlan::rootsAt); else none
  std::span<const Vec3d> strandRoots{};              // likewise of strands
};

class HairPane {
 public:
  /// Of the groom's hair. Errors: the device lacks memory.
  static Result<HairPane> create(gpu::Device& device, const Groom& groom, const PaneLook& look);
  HairPane(HairPane&&) = default;

  /// Draws this hair from now on. Again after its buffers are others, or strands were cut beyond other
  /// points.
  Status attach(gpu::Device& device, const Simulation& hair, std::span<const std::uint32_t> cutBeyond = {});

  /// The next picture. Places of solids, of what is about the hair, and the camera are the world's.
  Status setFrame(const Camera& camera, const HeadPose& head, std::span<const SolidPlace> solids,
                  const HairSurroundings& about);
  void record(gpu::CommandList& list, Quatd head) const;
  /// Of what was recorded and is done: the box about the hair is known for the next picture.
  void finish();

  const gpu::Buffer& shown() const { return renderer_->shown(); }
  const PictureSize& size() const { return size_; }

 private:
  HairPane() = default;

  std::vector<Vec3d> rest_;
  std::vector<std::uint32_t> firstPoint_;
  PictureSize size_;
  // Where they are does not change, as others refer to them.
  std::unique_ptr<FollowStage> follow_;
  std::unique_ptr<StrandPoints> strands_;
  std::optional<HairRenderer> renderer_;
  std::optional<StretchColours> stretch_;
  std::optional<DevicePose> pose_;
  Bounds box_;  // relative to the head
};

}  // namespace ringlet::view
