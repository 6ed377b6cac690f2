// FollowStage: hairs that follow guides, on one device (shaders/kernels/follow_*.comp). Mirrored by
// reference/follow_guide.h.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/follow/follow_hairs.h"
#include "ringlet/follow/posed_bodies.h"
#include "ringlet/gpu/bound_kernel.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/command_list.h"

namespace ringlet {

class FollowStage {
 public:
  /// `hairs`: of these guides. `bodies`: that hairs stay out of where their guides do; they
  /// pass checkBody. Errors: the device lacks memory, or sees too little of a buffer at once; the message
  /// says how many hairs it has room for. Cost: the guides' cores, on all processors.
  /// `isOnScalp`: setPose says where the hairs' roots are. `own`: of hairs that have points of their own.
  static Result<FollowStage> create(gpu::Device& device, std::span<const GuideRest> guides,
                                    std::span<const FollowHair> hairs, std::span<const Body> bodies = {},
                                    bool isOnScalp = false, const OwnPoints& own = {});
  FollowStage(FollowStage&&) = default;

  /// The guides' particles [m], one after the other in the guides' order. The next frame follows them. No
  /// submission may be using them meanwhile. `roots`: of hairs on a scalp [m], one each; else none.
  /// `cutBeyond`: the particles beyond which guides are cut by now, before pieces of GuideRest.
  Status setPose(std::span<const Vec3d> positions, std::span<const Vec3d> roots = {},
                 std::span<const std::uint32_t> cutBeyond = {});

  /// The same of the roots alone, where the pose is written on the device: of hairs, and of their guides [m].
  Status setRoots(std::span<const Vec3d> roots, std::span<const Vec3d> guideRoots);

  /// vec4[particles]: the pose on the device, for what writes it there (DevicePose).
  const gpu::Buffer& pose() const { return positions_; }

  /// Where bodies are in the next frame, as PosedBodies::setPoses takes them; `origin` is where the guides'
  /// particles are seen from.
  void setBodies(std::span<const BodyPose> poses, std::span<const std::vector<Vec3d>> points = {},
                 Vec3d origin = {}) {
    bodies_.setPoses(poses, points, origin);
  }

  /// Moves the hairs to the pose. `head`: how the head has turned since the rest pose. Ends with a barrier.
  void record(gpu::CommandList& list, Quatd head);

  /// uvec4[pointCount()]: x, y, z as the bits of floats [m]; the hair's number, with kHairEnd
  /// (layout/hair_points.h) at its last point and before a cut.
  const gpu::Buffer& points() const { return points_; }
  std::uint32_t pointCount() const { return pointCount_; }
  std::uint32_t hairCount() const { return hairCount_; }
  /// Of each hair, and one more.
  const std::vector<std::uint32_t>& firstPoint() const { return firstPoint_; }
  std::uint64_t byteCount() const;  // of all its buffers

 private:
  FollowStage(gpu::Buffer positions, gpu::Buffer points, PosedBodies bodies)
      : positions_(std::move(positions)), points_(std::move(points)), bodies_(std::move(bodies)) {}
  Status makeHairs(gpu::Device& device, std::span<const FollowHair> hairs);
  Status makeOwnPoints(gpu::Device& device, const OwnPoints& own);
  Status makeGuides(gpu::Device& device, std::span<const GuideRest> guides);
  Status makeInside(gpu::Device& device);
  Status makeKernels(gpu::Device& device, bool isOnScalp, bool areCut, bool haveOwn);

  // Points of hairs inside bodies: how many there are, none, and which.
  struct Inside {
    gpu::Buffer count, none, points;
  };

  gpu::Buffer positions_, points_;
  PosedBodies bodies_;
  std::optional<Inside> inside_;  // where there are bodies
  std::vector<gpu::Buffer> others_;
  std::optional<gpu::Buffer> blends_;      // where hairs follow several guides
  std::vector<gpu::BoundKernel> kernels_;  // in their order; that of bodies only where there are any
  std::vector<FollowHair> onScalp_;        // the hairs, where a scalp carries their roots; else none
  std::vector<std::uint32_t> guideRoots_;  // the particle at the root of each guide
  std::vector<std::uint32_t> firstPoint_{0};
  std::uint32_t guideCount_ = 0, particleCount_ = 0, hairCount_ = 0, pointCount_ = 0, stride_ = 0;
};

}  // namespace ringlet
