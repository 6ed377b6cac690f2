// DevicePose: hair that is simulated on a device, put where what follows or draws it on the same device wants
// its points (shaders/kernels/pose_*.comp). Positions do not cross to the host; the box about them does.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/gpu/bound_kernel.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/command_list.h"

namespace ringlet {

/// A part of the hair, as the solver has it.
struct PoseSource {
  const gpu::Buffer& positions;              // four floats a particle [m]; it lives as long as the DevicePose
  std::span<const std::uint32_t> particles;  // the groom's index of each
};

/// What stands behind the three coordinates of a point.
enum class PoseTag {
  none,    // 0, or -1 before a cut, as FollowStage::pose has it
  strand,  // the strand and whether it ends there or is cut, as DrawnHairs::points has it
};

/// The strands of a groom.
struct PoseStrands {
  std::span<const Vec3d> rest;  // all points [m]; those that no source has are carried by the head
  std::span<const std::uint32_t> firstPoint;   // of each strand, and one more
  std::span<const std::uint32_t> cutBeyond{};  // points beyond which strands are cut
  PoseTag tag = PoseTag::none;
};

class DevicePose {
 public:
  /// `target`: 16 bytes a point, groom order; it lives as long. Errors: the device lacks memory.
  static Result<DevicePose> create(gpu::Device& device, std::span<const PoseSource> sources,
                                   const PoseStrands& strands, const gpu::Buffer& target);
  DevicePose(DevicePose&&) = default;
  DevicePose& operator=(DevicePose&&) = default;

  /// Positions as they are then, relative to the head's origin along world axes, into the target. `head`: how
  /// the head has turned since the rest pose. Ends with a barrier.
  void record(gpu::CommandList& list, Quatd head) const;

  /// The box about all points, when what was recorded is done.
  struct Box {
    Vec3d low, high;  // [m]
  };
  Box box() const;

 private:
  struct Part {
    gpu::BoundKernel move;
    std::uint32_t count = 0;
    bool isCarried = false;
  };
  explicit DevicePose(gpu::Buffer bounds, gpu::Buffer seen)
      : bounds_(std::move(bounds)), seen_(std::move(seen)) {}
  Status addPart(gpu::Device& device, const gpu::Buffer& positions, std::span<const std::uint32_t> particles,
                 bool isCarried);

  gpu::Buffer bounds_, seen_;  // on the device; and what the host sees of it
  std::vector<gpu::Buffer> others_;
  std::vector<Part> parts_;
  std::optional<gpu::BoundKernel> surround_;  // once made
  std::vector<std::uint32_t> tags_;           // of all points
  const gpu::Buffer* target_ = nullptr;
  std::uint32_t pointCount_ = 0;
};

}  // namespace ringlet
