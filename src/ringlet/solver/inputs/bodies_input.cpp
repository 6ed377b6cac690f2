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
  PackedBodies packedBodies = packBodies(bodies);
  auto restBuffer = createFilled(from.device, packedBodies.rests, "bodies");
  if (!restBuffer) return restBuffer.error();
  auto cellBuffer = createFilled(from.device, packedBodies.cells, "distance grids");
  if (!cellBuffer) return cellBuffer.error();
  BodiesInput self(std::move(*restBuffer), std::move(*cellBuffer));
  const auto mostSteps = static_cast<std::uint64_t>(from.settings.stepsPerFrame);
  const std::uint64_t poseBytes = (mostSteps + 1) * bodies.size() * sizeof(layout::BodyPose);
  if (Status status = self.stage(from, poseBytes, "body poses"); !status) return status.error();
  self.bodies_.assign(bodies.begin(), bodies.end());
  self.packed_ = std::move(packedBodies.rests);
  self.now_.assign(places.begin(), places.end());
  if (places.empty())
    for (const Body& body : bodies) self.now_.push_back(body.poseAt(0, head));
  return self;
}

void BodiesInput::writeFrame(std::size_t slot, const FrameContext& frame) {
  const std::size_t count = bodies_.size();
  if (count == 0) return;
  const std::span<const HeadPose> heads = frame.heads.subspan(1);
  const std::span<const BodyPose> poses = frame.bodyPoses;
  RINGLET_ASSERT(poses.empty() || poses.size() == frame.steps() * count,
                 "every body has a pose in every step");
  const auto out = staged_[0].of<layout::BodyPose>(slot);
  for (std::size_t b = 0; b < count; ++b) {
    out[b] = {
        packed3(now_[b].position - heads[0].position), 0, packed(now_[b].rotation), packed(Quatd{}), {}};
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
      out[k * count + b] = {packed3(to), static_cast<float>(moves), packed(next.rotation), packed(turn),
                            packed((to - from) / frame.stepSeconds)};
      now_[b] = next;
    }
  }
}

bool BodiesInput::isQuiet(const FrameContext& frame) const {
  for (std::size_t k = 0; k < frame.bodyPoses.size(); ++k)
    if (frame.bodyPoses[k] != now_[k % now_.size()]) return false;
  return true;
}

void BodiesInput::jump(const FrameContext& frame) {
  const std::size_t count = bodies_.size();
  const std::span<const BodyPose> poses = frame.bodyPoses;
  for (std::size_t b = 0; b < count; ++b)
    now_[b] = poses.empty() ? bodies_[b].poseAt(0, frame.end()) : poses[poses.size() - count + b];
}

gpu::BufferTable BodiesInput::bufferTable(std::size_t) const {
  using namespace layout;
  return {{kBindBodies, rests_},         {kBindBodyPoses, staged_[0].seen()},
          {kBindGridCells, cells_},      {kBindBodyTexels, rests_},
          {kBindGridCellTexels, cells_}, {kBindBodyPoseTexels, staged_[0].seen()}};
}
std::uint64_t BodiesInput::largestBuffer() const {
  return std::max(cells_.bytes(), FrameInput::largestBuffer());
}
std::uint64_t BodiesInput::bytes() const { return FrameInput::bytes() + rests_.bytes() + cells_.bytes(); }

}  // namespace ringlet
