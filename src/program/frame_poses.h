// FramePoses: where everything that moves by itself is in the steps of a frame.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "program/backend.h"
#include "program/simulate_run.h"
#include "ringlet/base/result.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scenes/scene_forces.h"

namespace ringlet::program {

/// Where head, bodies and roots are at the end of every step of a frame.
struct FramePoses {
  std::vector<HeadPose> heads;
  std::vector<BodyPose> bodies;  // as bodyPosesOf gives them
  std::vector<BodyPose> roots;   // as Simulation::stepFrame takes them
  FrameForces forces;            // of the whole frame

  /// Hands over steps [first, first + count) of them.
  Status submit(Backend& backend, std::size_t first, std::size_t count) const {
    const auto ofSteps = [&](const std::vector<BodyPose>& poses) {
      const std::size_t each = poses.size() / heads.size();
      return std::span(poses).subspan(first * each, count * each);
    };
    const auto share = [&](std::size_t step) {
      return static_cast<double>(step) / static_cast<double>(heads.size());
    };
    const bool isWhole = count == heads.size();
    Status set = isWhole ? forces.set(backend) : forces.part(share(first), share(first + count)).set(backend);
    if (!set) return set;
    return backend.submitFrame(std::span(heads).subspan(first, count), ofSteps(bodies), ofSteps(roots));
  }
  Status submit(Backend& backend) const { return submit(backend, 0, heads.size()); }
  Status step(Backend& backend, std::size_t first, std::size_t count) const {
    if (Status handed = submit(backend, first, count); !handed) return handed;
    return backend.waitFrame();
  }
  std::span<const BodyPose> bodiesAtEnd() const {
    return std::span(bodies).last(bodies.size() / heads.size());
  }
};

/// Frame 0 is the first that is written. Times are exact quotients, so they do not drift.
/// Errors: an animation of the scene that cannot be read.
Result<FramePoses> posesOfFrame(const RunInput& input, int frame);

}  // namespace ringlet::program
