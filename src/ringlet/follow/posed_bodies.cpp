// Implements follow/posed_bodies.h.
#include "ringlet/follow/posed_bodies.h"

#include <cstring>

#include "layout/bodies.h"
#include "ringlet/base/assert.h"
#include "ringlet/base/packed.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/rest/packed_bodies.h"
#include "ringlet/solver/inputs/bending_bodies.h"

namespace ringlet {

std::vector<Body> metByFollowers(std::span<const Body> bodies) {
  std::vector<Body> met(bodies.begin(), bodies.end());
  for (Body& body : met)
    if (body.isCloth()) body = {.shape = BodyShape::sphere, .radius = 1e-6};
  return met;
}

std::vector<std::vector<Vec3d>> metByFollowers(std::span<const Body> bodies,
                                               std::span<const std::vector<Vec3d>> points) {
  std::vector<std::vector<Vec3d>> met;
  std::size_t m = 0;
  for (const Body& body : bodies) {
    if (points.empty() || !body.bends()) continue;
    if (!body.isCloth()) met.push_back(points[m]);
    ++m;
  }
  return met;
}

struct PosedBodies::Bending {
  BendingBodies bodies;
  gpu::Buffer points;
  BendingBodies::Work work;  // that no commands do yet
};

PosedBodies::PosedBodies(std::span<const Body> bodies, gpu::Buffer poses)
    : bodies_(bodies.begin(), bodies.end()), poses_(std::move(poses)) {}
PosedBodies::PosedBodies(PosedBodies&&) noexcept = default;
PosedBodies::~PosedBodies() = default;

Result<PosedBodies> PosedBodies::create(gpu::Device& device, std::span<const Body> bodies) {
  auto poses = gpu::Buffer::create(device, bodies.size() * sizeof(layout::BodyPose), gpu::BufferKind::stream,
                                   "poses of bodies that hairs stay out of");
  if (!poses) return poses.error();
  PosedBodies self(bodies, std::move(*poses));
  if (Status made = self.makeGrids(device, metByFollowers(bodies)); !made) return made.error();
  return self;
}

Status PosedBodies::makeGrids(gpu::Device& device, std::span<const Body> met) {
  PackedBodies packed = packBodies(met);
  BendingBodies bending(met, 1);
  const auto firstPair = static_cast<std::uint32_t>(packed.pairs.size());
  packed.pairs.resize(firstPair + bending.pairCount());
  auto pairs = createFilled(device, packed.pairs, "distance grids of bodies that hairs stay out of");
  if (!pairs) return pairs.error();
  pairs_ = std::make_unique<gpu::Buffer>(std::move(*pairs));
  if (bending.areThere()) {
    auto points = gpu::Buffer::create(device, bending.pointBytes(), gpu::BufferKind::stream,
                                      "points of bodies that bend");
    if (!points) return points.error();
    bending_ = std::make_unique<Bending>(Bending{std::move(bending), std::move(*points), {}});
    Status made = bending_->bodies.createFields(device, bending_->points, *pairs_, firstPair, packed.rests);
    if (!made) return made;
  }
  auto rests = createFilled(device, packed.rests, "bodies that hairs stay out of");
  if (!rests) return rests.error();
  rests_.emplace(std::move(*rests));
  return {};
}

void PosedBodies::setPoses(std::span<const BodyPose> poses, std::span<const std::vector<Vec3d>> points,
                           Vec3d origin) {
  RINGLET_ASSERT(poses.empty() || poses.size() == count(), "every body has a pose");
  metCount_ = static_cast<std::uint32_t>(poses.size());
  for (std::size_t b = 0; b < poses.size(); ++b) {
    const BodyPose& pose = poses[b];
    const Vec3d position = pose.position - origin;
    const layout::BodyPose record{.position = packed3(position),
                                  .moves = 0,
                                  .rotation = packed(pose.rotation),
                                  .turn = packed(Quatd{}),
                                  .velocity = {},
                                  .field = 0};
    std::memcpy(poses_.mapped().data() + b * sizeof(record), &record, sizeof(record));
  }
  if (!bending_) return;
  std::vector<layout::vec4> written(bending_->points.bytes() / sizeof(layout::vec4));
  const auto work = bending_->bodies.writeMoment(metByFollowers(bodies_, points), written);
  if (work == BendingBodies::Work{}) return;
  std::memcpy(bending_->points.mapped().data(), written.data(), bending_->points.bytes());
  bending_->work = work;
}

void PosedBodies::record(gpu::CommandList& list) {
  if (bending_) bending_->bodies.record(list, std::exchange(bending_->work, {}));
}

std::uint64_t PosedBodies::byteCount() const {
  const std::uint64_t bytes = rests_->bytes() + pairs_->bytes() + poses_.bytes();
  return bending_ ? bytes + bending_->points.bytes() + bending_->bodies.fields()->bytes() : bytes;
}

gpu::BufferTable PosedBodies::bufferTable() const {
  using namespace layout;
  return {{kBindBodies, *rests_},        {kBindBodyTexels, *rests_}, {kBindBodyPoses, poses_},
          {kBindBodyPoseTexels, poses_}, {kBindGridPairs, *pairs_},  {kBindGridPairTexels, *pairs_}};
}

}  // namespace ringlet
