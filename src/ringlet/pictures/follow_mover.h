// FollowMover: moves hairs that follow strands to a pose of the strands, and returns their points.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/scene/body.h"
#include "ringlet/solver/compute_device.h"

namespace ringlet {

class FollowPlan;

/// A pose of the strands, in their groom's unit and order; with one pose per body, or none, in which case
/// bodies are left out; with SceneFrames::bodyPointsAt, or none: bodies keep their shape; and with
/// FollowPlan::rootsAt.
struct StrandsPose {
  std::span<const Vec3f> points;
  std::span<const BodyPose> bodies{};
  std::span<const std::vector<Vec3d>> bodyPoints{};
  std::span<const Vec3d> roots{};
};

class FollowMover {
 public:
  virtual ~FollowMover() = default;
  /// `hairs`: receives the points of all hairs, hair after hair, in the groom's unit.
  virtual Status move(const StrandsPose& pose, std::span<Vec3f> hairs) = 0;
};

/// The plan must outlive what is made. `bodies`: hairs are kept out of them.
using FollowMoverMaker =
    std::function<Result<std::unique_ptr<FollowMover>>(const FollowPlan& plan, std::span<const Body> bodies)>;

/// On a device, in single precision.
FollowMoverMaker followOn(ComputeDevice device);

}  // namespace ringlet
