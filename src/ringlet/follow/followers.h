// Followers: hairs that follow the strands of a Simulation, on its device: the rest of a head of which only a
// share is simulated (level_of_detail.h), or full hair (follow_hairs.h). Positions do not leave the device.
//
//   stepFrame(guides)                                        follow -> positions
//   recordFrames(guides, commands)   record(commands)   the host submits and draws from points()
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/follow/follow_hairs.h"
#include "ringlet/groom/groom.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {

/// Points of hairs in device memory, for a host that draws from there: four words a point, x y z as floats
/// [m] relative to the head's origin along world axes, then the hair's number, with bit 31 set at its last
/// point. Valid as long as the Followers. Commands of the host that read it begin with a barrier from compute
/// writes.
struct FollowedPoints {
  void* buffer = nullptr;  // VkBuffer; where handles are 64 bits
  std::uint64_t bytes = 0;
};

/// For one thread at a time, which is not in a call of the Simulation meanwhile. Not for hair that is cut
/// (Simulation::cut): on the device only what is kept is known.
class Followers {
 public:
  /// `guides`: a simulation of `groom` on `device`, which lives as long as this. `hairs`: each follows a
  /// strand of that groom. `bodies`: that hairs stay out of where their strands do; they pass checkBody.
  /// `own`: of hairs that have points of their own (LevelOfDetail::own).
  /// Errors: a strand without length; the device lacks memory. Cost: the cores of all strands; 48 bytes a
  /// hair, 96 where one follows several strands, and 16 a point of device memory, 32 with points of their
  /// own.
  static Result<Followers> create(const ComputeDevice& device, const Simulation& guides, const Groom& groom,
                                  std::span<const FollowHair> hairs, std::span<const Body> bodies = {},
                                  const OwnPoints& own = {});
  Followers(Followers&&) noexcept;
  Followers& operator=(Followers&&) noexcept;
  ~Followers();

  /// Moves the hairs to where the strands are after the last frame, and waits. `bodies`: one pose a body;
  /// `points`: of those that bend, at one time; none: they keep their shape.
  Status follow(std::span<const BodyPose> bodies = {}, BodyPoints points = {});

  /// Records the same into `commandBuffer`, a VkCommandBuffer outside a render pass, behind what recordFrames
  /// recorded of the same frame; `head`: the head's pose at its end. The commands begin and end with a
  /// barrier between compute and copies. The host submits it once, and records again when it is done.
  void record(void* commandBuffer, const HeadPose& head, std::span<const BodyPose> bodies = {},
              BodyPoints points = {});

  FollowedPoints points() const;
  /// Where each hair's points begin in points(), and one more entry.
  const std::vector<std::uint32_t>& firstPoint() const;
  /// Copied to the host: all points, hair after hair [m], relative to the head's origin. It waits.
  Result<std::vector<Vec3f>> positions() const;
  std::uint64_t byteCount() const;  // of its buffers on the device

 private:
  struct Implementation;
  explicit Followers(std::unique_ptr<Implementation>);
  std::unique_ptr<Implementation> self_;
};

}  // namespace ringlet
