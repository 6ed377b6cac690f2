// Implements follow/device_pose.h.
#include "ringlet/follow/device_pose.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "layout/hair_points.h"
#include "layout/pose.h"
#include "ringlet/base/packed.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet_shaders/pose_bounds_plain.h"
#include "ringlet_shaders/pose_points_plain.h"

namespace ringlet {
namespace {

constexpr std::uint32_t kPointsEach = 64;  // that an invocation looks at for the box

std::vector<std::uint32_t> tagsOf(std::span<const std::uint32_t> firstPoint, PoseTag tag,
                                  std::span<const std::uint32_t> cutBeyond) {
  std::vector<std::uint32_t> tags(firstPoint.back(), 0);
  if (tag == PoseTag::none) {
    for (const std::uint32_t point : cutBeyond) tags[point] = std::bit_cast<std::uint32_t>(-1.f);
    return tags;
  }
  for (std::uint32_t strand = 0; strand + 1 < firstPoint.size(); ++strand) {
    std::fill(tags.begin() + firstPoint[strand], tags.begin() + firstPoint[strand + 1], strand);
    tags[firstPoint[strand + 1] - 1] |= layout::kHairEnd;
  }
  for (const std::uint32_t point : cutBeyond) tags[point] |= layout::kHairEnd;
  return tags;
}

gpu::KernelDescription describe(const gpu::Device& device, const char* name,
                                std::span<const std::uint32_t> spirv, bool texels) {
  gpu::KernelDescription description;
  description.name = name;
  description.spirv = spirv;
  description.pushConstantBytes = sizeof(layout::PoseParameters);
  description.groupSize = device.pointGroupSize();
  description.constants = {{layout::kSpecGroupSize, description.groupSize},
                           {layout::kSpecTexels, texels ? 1u : 0u}};
  return description;
}

// Back from ordered bits (pose_bounds.comp).
double valueOf(std::uint32_t ordered) {
  return std::bit_cast<float>(ordered >> 31 ? ordered ^ 0x80000000u : ~ordered);
}

}  // namespace

Status DevicePose::addPart(gpu::Device& device, const gpu::Buffer& positions,
                           std::span<const std::uint32_t> particles, bool isCarried) {
  if (particles.empty()) return {};
  std::vector<layout::PosePlace> places;
  for (const std::uint32_t point : particles) places.push_back({.point = point, .tag = tags_[point]});
  auto filled = createFilled(device, places, "places of simulated hair");
  if (!filled) return filled.error();
  const bool texels = isSeenAsTexels(device, positions.bytes());
  auto move = gpu::BoundKernel::create(device, describe(device, "pose_points", k_pose_points_plain, texels),
                                       {{layout::kBindPosePositions, positions},
                                        {layout::kPoseTexels + layout::kBindPosePositions, positions},
                                        {layout::kBindPosePlaces, *filled},
                                        {layout::kBindPosePoints, *target_}});
  if (!move) return move.error();
  others_.push_back(std::move(*filled));
  parts_.push_back({std::move(*move), static_cast<std::uint32_t>(particles.size()), isCarried});
  return {};
}

Result<DevicePose> DevicePose::create(gpu::Device& device, std::span<const PoseSource> sources,
                                      const PoseStrands& strands, const gpu::Buffer& target) {
  auto bounds = createZero(device, sizeof(layout::PoseBounds), "box about the hair");
  if (!bounds) return bounds.error();
  auto seen = gpu::Buffer::create(device, sizeof(layout::PoseBounds), gpu::BufferKind::stream,
                                  "box about the hair, for the host");
  if (!seen) return seen.error();
  DevicePose self(std::move(*bounds), std::move(*seen));
  self.pointCount_ = strands.firstPoint.back();
  self.target_ = &target;
  self.tags_ = tagsOf(strands.firstPoint, strands.tag, strands.cutBeyond);

  std::vector<bool> isSimulated(self.pointCount_, false);
  for (const PoseSource& source : sources)
    for (const std::uint32_t point : source.particles) isSimulated[point] = true;
  std::vector<std::uint32_t> carried;
  std::vector<layout::vec4> carriedPoints;
  for (std::uint32_t i = 0; i < self.pointCount_; ++i) {
    if (isSimulated[i]) continue;
    carried.push_back(i);
    carriedPoints.push_back(packed(strands.rest[i]));
  }
  auto still = createFilled(device, carriedPoints, "hair that the head carries");
  if (!still) return still.error();
  self.others_.reserve(sources.size() + 2);  // buffers that are bound stay where they are
  self.others_.push_back(std::move(*still));
  auto surround =
      gpu::BoundKernel::create(device, describe(device, "pose_bounds", k_pose_bounds_plain, false),
                               {{layout::kBindPosePoints, target}, {layout::kBindPoseBounds, self.bounds_}});
  if (!surround) return surround.error();
  self.surround_.emplace(std::move(*surround));
  if (Status added = self.addPart(device, self.others_.front(), carried, true); !added) return added.error();
  for (const PoseSource& source : sources) {
    if (Status added = self.addPart(device, source.positions, source.particles, false); !added)
      return added.error();
  }
  return self;
}

void DevicePose::record(gpu::CommandList& list, Quatd head) const {
  list.fillZero(bounds_);
  const layout::vec4 turn = packed(head);
  for (const Part& part : parts_) {
    const layout::PoseParameters parameters{
        .turn = turn, .count = part.count, .isTurned = part.isCarried ? 1u : 0u};
    part.move.dispatch(list, parameters, part.count);
  }
  list.barrier();
  const std::uint32_t invocations = (pointCount_ + kPointsEach - 1) / kPointsEach;
  surround_->dispatch(list, layout::PoseParameters{.turn = turn, .count = pointCount_, .isTurned = 0},
                      invocations);
  list.barrier();
  list.copyBuffer(bounds_, seen_, sizeof(layout::PoseBounds));
  list.barrier();
}

DevicePose::Box DevicePose::box() const {
  layout::PoseBounds found;
  std::memcpy(&found, seen_.mapped().data(), sizeof(found));
  const auto all = [](auto&& of) { return Vec3d{of(0), of(1), of(2)}; };
  return {all([&](int axis) { return valueOf(~found.low[axis]); }),
          all([&](int axis) { return valueOf(found.high[axis]); })};
}

}  // namespace ringlet
