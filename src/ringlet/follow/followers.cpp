// Implements follow/followers.h: DevicePose brings strands from the solver's order to the groom's,
// FollowStage moves the hairs.
#include "ringlet/follow/followers.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <optional>
#include <utility>

#include "layout/types.h"
#include "ringlet/base/assert.h"
#include "ringlet/follow/device_pose.h"
#include "ringlet/follow/follow_stage.h"
#include "ringlet/follow/guide_rest.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/gpu/recorder.h"

namespace ringlet {
namespace {

std::vector<std::size_t> whichBend(std::span<const Body> bodies) {
  std::vector<std::size_t> which;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies[b].bends()) which.push_back(b);
  return which;
}

}  // namespace

struct Followers::Implementation {
  ComputeDevice device;
  std::vector<std::size_t> bending;  // which of the bodies bend
  const Simulation* guides;
  FollowStage stage;
  std::optional<DevicePose> pose;
  gpu::Recorder recorder;

  std::vector<std::vector<Vec3d>> seenFromCarriers(std::span<const BodyPose> poses, BodyPoints points) const {
    RINGLET_ASSERT(points.empty() || points.size() == bending.size(), "every body that bends has points");
    std::vector<std::vector<Vec3d>> seen(points.size());
    for (std::size_t m = 0; m < points.size(); ++m)
      for (const Vec3d p : points[m]) seen[m].push_back(seenFrom(poses[bending[m]], p));
    return seen;
  }
  void record(gpu::CommandList& list, const HeadPose& head, std::span<const BodyPose> bodies,
              BodyPoints points) {
    stage.setBodies(bodies, seenFromCarriers(bodies, points), head.position);
    pose->record(list, head.rotation);
    stage.record(list, head.rotation);
  }
};

Followers::Followers(std::unique_ptr<Implementation> self) : self_(std::move(self)) {}
Followers::Followers(Followers&&) noexcept = default;
Followers& Followers::operator=(Followers&&) noexcept = default;
Followers::~Followers() = default;

Result<Followers> Followers::create(const ComputeDevice& device, const Simulation& guides, const Groom& groom,
                                    std::span<const FollowHair> hairs, std::span<const Body> bodies,
                                    const OwnPoints& own) {
  std::vector<Vec3d> rest;
  for (const Vec3f& p : groom.points) rest.push_back(Vec3d(p) * groom.metresPerUnit);
  std::vector<GuideRest> guideRests;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const auto strand = std::span(rest).subspan(groom.firstPoint[s], groom.strand(s).size());
    if (std::ranges::all_of(strand, [&](const Vec3d& p) { return p == strand.front(); }))
      return Error{fmt::format("strand {} of the groom has no length, so that no hair can follow it", s + 1)};
    guideRests.push_back(restOfGuide(strand));
  }
  for (const FollowHair& hair : hairs) {
    const auto isThere = [&](std::uint32_t guide) { return guide < guideRests.size(); };
    RINGLET_ASSERT(isThere(hair.guide), "a hair follows a strand that the groom does not have");
    for (const FollowHair::Other& other : hair.others)
      RINGLET_ASSERT(isThere(other.guide), "a hair follows a strand that the groom does not have");
  }
  auto stage = FollowStage::create(device.gpu(), guideRests, hairs, bodies, false, own);
  if (!stage) return stage.error();
  auto recorder = gpu::Recorder::create(device.gpu(), "hairs that follow strands");
  if (!recorder) return recorder.error();
  auto self = std::make_unique<Implementation>(Implementation{
      device, whichBend(bodies), &guides, std::move(*stage), std::nullopt, std::move(*recorder)});
  const std::vector<DevicePositions> parts = guides.devicePositions();
  std::vector<PoseSource> sources;
  for (const DevicePositions& part : parts) sources.push_back({*part.own, part.particles});
  auto pose = DevicePose::create(device.gpu(), sources, {.rest = rest, .firstPoint = groom.firstPoint},
                                 self->stage.pose());
  if (!pose) return pose.error();
  self->pose.emplace(std::move(*pose));
  return Followers(std::move(self));
}

Status Followers::follow(std::span<const BodyPose> bodies, BodyPoints points) {
  const HeadPose head = self_->guides->head();
  if (Status begun = self_->recorder.begin(); !begun) return begun;
  self_->record(self_->recorder, head, bodies, points);
  return self_->recorder.submitAndWait();
}

void Followers::record(void* commandBuffer, const HeadPose& head, std::span<const BodyPose> bodies,
                       BodyPoints points) {
  gpu::CommandList list;
  self_->record(list, head, bodies, points);
  list.recordInto(self_->device.gpu(), static_cast<VkCommandBuffer>(commandBuffer));
}

FollowedPoints Followers::points() const {
  const gpu::Buffer& points = self_->stage.points();
  return {.buffer = reinterpret_cast<void*>(points.handle()), .bytes = points.bytes()};
}

const std::vector<std::uint32_t>& Followers::firstPoint() const { return self_->stage.firstPoint(); }

Result<std::vector<Vec3f>> Followers::positions() const {
  const auto records = downloadAll<layout::uvec4>(self_->stage.points(), self_->stage.pointCount());
  if (!records) return records.error();
  std::vector<Vec3f> points;
  points.reserve(records->size());
  for (const layout::uvec4& record : *records)
    points.push_back(
        {std::bit_cast<float>(record.x), std::bit_cast<float>(record.y), std::bit_cast<float>(record.z)});
  return points;
}

std::uint64_t Followers::byteCount() const { return self_->stage.byteCount(); }

}  // namespace ringlet
