// Implements solver/inputs/bodies_input.h.
#include "ringlet/solver/inputs/bodies_input.h"

#include <algorithm>
#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/base/packed.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/rest/packed_bodies.h"
#include "ringlet/solver/inputs/frame_inputs.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {

Result<BodiesInput> BodiesInput::create(const InputSource& from) {
  return create(from, from.initial.bodies, from.initial.bodyPlaces, from.initial.head);
}

Result<BodiesInput> BodiesInput::create(const InputSource& from, std::span<const Body> bodies,
                                        std::span<const BodyPose> places, const HeadPose& head) {
  RINGLET_ASSERT(places.empty() || places.size() == bodies.size(), "every body has a place");
  for (const Body& body : bodies) {
    if (Status status = checkBody(body); !status) return status.error();
  }
  const auto mostSteps = static_cast<std::uint32_t>(from.settings.stepsPerFrame);
  BodiesInput self(BendingBodies(bodies, mostSteps + 1));
  self.work_.resize(from.slots);
  PackedBodies packed = packBodies(bodies);
  const std::uint64_t poseBytes = (mostSteps + std::uint64_t{1}) * bodies.size() * sizeof(layout::BodyPose);
  if (Status status = self.stage(from, poseBytes, "body poses"); !status) return status.error();
  self.bodies_.assign(bodies.begin(), bodies.end());
  if (Status status = self.makeGrids(from, packed); !status) return status.error();
  if (Status status = self.makeLists(from); !status) return status.error();
  self.packed_ = std::move(packed.rests);
  self.now_.assign(places.begin(), places.end());
  if (places.empty())
    for (const Body& body : bodies) self.now_.push_back(body.poseAt(0, head));
  return self;
}

// The grids of bodies that do not bend, and room behind them for the fields of those that do.
Status BodiesInput::makeGrids(const InputSource& from, PackedBodies& bodies) {
  const auto firstPair = static_cast<std::uint32_t>(bodies.pairs.size());
  auto pairs = gpu::Buffer::create(from.device, (firstPair + bending_.pairCount()) * sizeof(std::uint32_t),
                                   gpu::BufferKind::storage, "distance grids");
  if (!pairs) return pairs.error();
  if (Status status = pairs->upload(std::as_bytes(std::span(bodies.pairs))); !status) return status;
  pairs_ = std::make_unique<gpu::Buffer>(std::move(*pairs));
  if (bends()) {
    if (Status status = stage(from, bending_.pointBytes(), "points of bodies that bend"); !status)
      return status;
    if (Status status =
            bending_.createFields(from.device, staged_[1].seen(), *pairs_, firstPair, bodies.rests);
        !status)
      return status;
  }
  auto rests = createFilled(from.device, bodies.rests, "bodies");
  if (!rests) return rests.error();
  rests_.emplace(std::move(*rests));
  return {};
}

// Kernels among bodies that bend have them bound, even if none is cloth.
Status BodiesInput::makeLists(const InputSource& from) {
  if (!bends()) return {};
  const auto cloth = static_cast<std::uint64_t>(std::ranges::count_if(bodies_, &Body::isCloth));
  for (const GroomChunk& chunk : from.chunks) {
    const std::uint64_t count = std::max<std::uint64_t>(cloth * chunk.particleCount(), 1);
    auto made = gpu::Buffer::create(from.device, count * sizeof(layout::ClothList), gpu::BufferKind::storage,
                                    "the triangles of cloth near to particles");
    if (!made) return made.error();
    lists_.push_back(std::move(*made));
  }
  return {};
}

void BodiesInput::writeFrame(std::size_t slot, const FrameContext& frame) {
  const std::size_t count = bodies_.size();
  if (count == 0) return;
  const std::span<const HeadPose> heads = frame.heads.subspan(1);
  const std::span<const BodyPose> poses = frame.bodyPoses;
  RINGLET_ASSERT(poses.empty() || poses.size() == frame.steps() * count,
                 "every body has a pose in every step");
  const auto out = staged_[0].of<layout::BodyPose>(slot);
  std::vector<float> fields(frame.steps() + 1);
  if (bends()) work_[slot] = bending_.writeFrame(frame, now_, staged_[1].of<layout::vec4>(slot), fields);
  for (std::size_t b = 0; b < count; ++b) {
    out[b] = {.position = packed3(now_[b].position - heads[0].position),
              .moves = 0,
              .rotation = packed(now_[b].rotation),
              .turn = packed(Quatd{}),
              .velocity = {},
              .field = bodies_[b].bends() ? fields[0] : 0};
  }
  for (std::size_t k = 1; k < heads.size(); ++k) {
    for (std::size_t b = 0; b < count; ++b) {
      const BodyPose next = poses.empty() ? bodies_[b].poseAt(0, heads[k]) : poses[(k - 1) * count + b];
      const Vec3d from = now_[b].position - heads[k - 1].position, to = next.position - heads[k].position;
      const Quatd turn = next.rotation * now_[b].rotation.conjugate();
      // The motion of the body's origin, and that which the turn adds for the point farthest from the origin.
      const layout::vec4& bounds = packed_[b].bounds;
      const double arm = length(Vec3d{bounds.x, bounds.y, bounds.z}) + bounds.w;
      const double moves = length(to - from) + 2 * arm * length(Vec3d{turn.x, turn.y, turn.z});
      out[k * count + b] = {.position = packed3(to),
                            .moves = static_cast<float>(moves),
                            .rotation = packed(next.rotation),
                            .turn = packed(turn),
                            .velocity = packed3((to - from) / frame.stepSeconds),
                            .field = bodies_[b].bends() ? fields[k] : 0};
      now_[b] = next;
    }
  }
}

bool BodiesInput::isQuiet(const FrameContext& frame) const {
  if (!bending_.isQuiet(frame)) return false;
  for (std::size_t k = 0; k < frame.bodyPoses.size(); ++k)
    if (frame.bodyPoses[k] != now_[k % now_.size()]) return false;
  return true;
}

void BodiesInput::jump(const FrameContext& frame) {
  const std::size_t count = bodies_.size();
  const std::span<const BodyPose> poses = frame.bodyPoses;
  bending_.jump(frame, now_);
  for (std::size_t b = 0; b < count; ++b)
    now_[b] = poses.empty() ? bodies_[b].poseAt(0, frame.end()) : poses[poses.size() - count + b];
}

gpu::BufferTable BodiesInput::bufferTable(std::size_t chunk) const {
  using namespace layout;
  gpu::BufferTable table{{kBindBodies, *rests_},         {kBindBodyPoses, staged_[0].seen()},
                         {kBindGridPairs, *pairs_},      {kBindBodyTexels, *rests_},
                         {kBindGridPairTexels, *pairs_}, {kBindBodyPoseTexels, staged_[0].seen()}};
  if (const MeshFields* fields = bending_.fields()) {
    table.insert({{kBindBodyKeys, fields->keys()},
                  {kBindBodyKeyTexels, fields->keys()},
                  {kBindBodyWays, fields->ways()},
                  {kBindBodyWayTexels, fields->ways()},
                  {kBindClothLists, lists_[chunk]}});
  }
  return table;
}
std::uint64_t BodiesInput::largestBuffer() const {
  std::uint64_t largest = std::max(pairs_->bytes(), FrameInput::largestBuffer());
  if (const MeshFields* fields = bending_.fields())
    largest = std::max({largest, fields->keys().bytes(), fields->ways().bytes()});
  return largest;
}
std::uint64_t BodiesInput::bytes() const {
  const MeshFields* fields = bending_.fields();
  std::uint64_t bytes =
      FrameInput::bytes() + rests_->bytes() + pairs_->bytes() + (fields ? fields->bytes() : 0);
  for (const gpu::Buffer& lists : lists_) bytes += lists.bytes();
  return bytes;
}

}  // namespace ringlet
