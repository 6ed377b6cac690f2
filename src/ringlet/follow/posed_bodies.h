// PosedBodies: bodies on a device, in the pose that hairs stay out of.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/scene/body.h"

namespace ringlet {

/// Bodies as hairs that follow meet them: they do not see those that bend, for each of which a grain stands.
std::vector<Body> metByFollowers(std::span<const Body> bodies);

class PosedBodies {
 public:
  /// The bodies pass checkBody. Errors: the device lacks memory.
  static Result<PosedBodies> create(gpu::Device& device, std::span<const Body> bodies);
  PosedBodies(PosedBodies&&) = default;

  std::uint32_t count() const { return count_; }
  /// One pose a body, whose positions are seen from `origin`. No submission may be using them meanwhile.
  void setPoses(std::span<const BodyPose> poses, Vec3d origin);
  /// As kernels bind them (layout/bodies.h, and layout/follow.h for the spheres about them).
  gpu::BufferTable bufferTable() const;
  std::uint64_t byteCount() const {
    return rests_.bytes() + pairs_.bytes() + poses_.bytes() + spheres_.bytes();
  }

 private:
  PosedBodies(gpu::Buffer rests, gpu::Buffer pairs, gpu::Buffer poses, gpu::Buffer spheres)
      : rests_(std::move(rests)),
        pairs_(std::move(pairs)),
        poses_(std::move(poses)),
        spheres_(std::move(spheres)) {}

  gpu::Buffer rests_, pairs_, poses_, spheres_;
  struct Sphere {
    Vec3d middle;   // [m]
    double radius;  // [m]
  };
  std::vector<Sphere> about_;  // each, in its own axes
  std::uint32_t count_ = 0;
};

}  // namespace ringlet
