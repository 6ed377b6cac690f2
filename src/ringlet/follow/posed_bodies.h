// PosedBodies: bodies on a device, in the pose that hairs stay out of.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/scene/body.h"

namespace ringlet {

/// Bodies as hairs that follow meet them: they do not see cloth, for each of which a grain stands.
std::vector<Body> metByFollowers(std::span<const Body> bodies);
/// Of points of each body that bends, those of bodies that they meet.
std::vector<std::vector<Vec3d>> metByFollowers(std::span<const Body> bodies,
                                               std::span<const std::vector<Vec3d>> points);

class PosedBodies {
 public:
  /// The bodies pass checkBody. Errors: the device lacks memory.
  static Result<PosedBodies> create(gpu::Device& device, std::span<const Body> bodies);
  PosedBodies(PosedBodies&&) noexcept;
  ~PosedBodies();

  std::uint32_t count() const { return static_cast<std::uint32_t>(bodies_.size()); }
  /// How many are met: all, or none where the last poses were none.
  std::uint32_t metCount() const { return metCount_; }
  /// One pose a body, whose positions are seen from `origin`, or none, in which case bodies are left out;
  /// `points`: of each that bends, seen from what carries it [m], or none: as before. No submission may be
  /// using them meanwhile.
  void setPoses(std::span<const BodyPose> poses, std::span<const std::vector<Vec3d>> points, Vec3d origin);
  /// Makes the grids of those that bend, if their points are others than in the last commands. Ends with a
  /// barrier where it does.
  void record(gpu::CommandList& list);
  /// As kernels bind them (layout/bodies.h).
  gpu::BufferTable bufferTable() const;
  std::uint64_t byteCount() const;

 private:
  struct Bending;  // bodies that bend, and their points
  PosedBodies(std::span<const Body> bodies, gpu::Buffer poses);
  Status makeGrids(gpu::Device& device, std::span<const Body> met);

  std::vector<Body> bodies_;
  std::uint32_t metCount_ = 0;
  std::unique_ptr<Bending> bending_;  // where there are any
  gpu::Buffer poses_;
  std::optional<gpu::Buffer> rests_;
  std::unique_ptr<gpu::Buffer> pairs_;  // where it stays: bending_ writes into it
};

}  // namespace ringlet
