// FollowMover: moves hairs that follow strands into a pose of these, and hands back where they are.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/scene/body.h"
#include "ringlet/solver/compute_device.h"

namespace ringlet {

class FollowPlan;

/// Of strands, in their groom's unit and order; one pose a body, or none, as if there were no bodies; and
/// FollowPlan::rootsAt.
struct StrandsPose {
  std::span<const Vec3f> points;
  std::span<const BodyPose> bodies{};
  std::span<const Vec3d> roots{};
};

class FollowMover {
 public:
  virtual ~FollowMover() = default;
  /// `hairs`: all of their points, hair after hair, in the groom's unit.
  virtual Status move(const StrandsPose& pose, std::span<Vec3f> hairs) = 0;
};

/// The plan lives as long as what is made. `bodies`: that hairs stay out of.
using FollowMoverMaker =
    std::function<Result<std::unique_ptr<FollowMover>>(const FollowPlan& plan, std::span<const Body> bodies)>;

/// On a device, in single precision.
FollowMoverMaker followOn(ComputeDevice device);

}  // namespace ringlet
