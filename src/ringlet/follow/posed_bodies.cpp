// Implements follow/posed_bodies.h.
#include "ringlet/follow/posed_bodies.h"

#include <cstring>

#include "layout/bodies.h"
#include "layout/follow.h"
#include "ringlet/base/assert.h"
#include "ringlet/base/packed.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/rest/packed_bodies.h"

namespace ringlet {
namespace {

constexpr double kRounding = 1.0001;  // what rounding to floats may leave out of a sphere

}  // namespace

std::vector<Body> metByFollowers(std::span<const Body> bodies) {
  std::vector<Body> met(bodies.begin(), bodies.end());
  for (Body& body : met)
    if (body.bends()) body = {.shape = BodyShape::sphere, .radius = 1e-6};
  return met;
}

Result<PosedBodies> PosedBodies::create(gpu::Device& device, std::span<const Body> bodies) {
  const PackedBodies packed = packBodies(metByFollowers(bodies));
  auto rests = createFilled(device, packed.rests, "bodies that hairs stay out of");
  if (!rests) return rests.error();
  auto pairs = createFilled(device, packed.pairs, "their distance grids");
  if (!pairs) return pairs.error();
  auto poses = gpu::Buffer::create(device, bodies.size() * sizeof(layout::BodyPose), gpu::BufferKind::stream,
                                   "their poses");
  if (!poses) return poses.error();
  auto spheres = gpu::Buffer::create(device, bodies.size() * sizeof(layout::vec4), gpu::BufferKind::stream,
                                     "spheres about them");
  if (!spheres) return spheres.error();
  PosedBodies self(std::move(*rests), std::move(*pairs), std::move(*poses), std::move(*spheres));
  for (const layout::BodyRest& rest : packed.rests)
    self.about_.push_back({{rest.bounds.x, rest.bounds.y, rest.bounds.z}, kRounding * rest.bounds.w});
  self.count_ = static_cast<std::uint32_t>(bodies.size());
  return self;
}

void PosedBodies::setPoses(std::span<const BodyPose> poses, Vec3d origin) {
  RINGLET_ASSERT(poses.size() == count_, "every body has a pose");
  for (std::size_t b = 0; b < poses.size(); ++b) {
    const BodyPose& pose = poses[b];
    const Vec3d position = pose.position - origin;
    const layout::BodyPose record{.position = packed3(position),
                                  .moves = 0,
                                  .rotation = packed(pose.rotation),
                                  .turn = packed(Quatd{}),
                                  .velocity = {},
                                  .field = 0};
    const layout::vec4 sphere = packed(position + rotate(pose.rotation, about_[b].middle), about_[b].radius);
    std::memcpy(poses_.mapped().data() + b * sizeof(record), &record, sizeof(record));
    std::memcpy(spheres_.mapped().data() + b * sizeof(sphere), &sphere, sizeof(sphere));
  }
}

gpu::BufferTable PosedBodies::bufferTable() const {
  using namespace layout;
  return {{kBindBodies, rests_},         {kBindBodyTexels, rests_}, {kBindBodyPoses, poses_},
          {kBindBodyPoseTexels, poses_}, {kBindGridPairs, pairs_},  {kBindGridPairTexels, pairs_},
          {kBindBodySpheres, spheres_}};
}

}  // namespace ringlet
