// Implements follow/follow_stage.h.
#include "ringlet/follow/follow_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <limits>
#include <thread>
#include <utility>

#include "layout/follow.h"
#include "layout/hair_points.h"
#include "ringlet/base/assert.h"
#include "ringlet/base/in_parallel.h"
#include "ringlet/base/packed.h"
#include "ringlet/follow/core_weights.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet_shaders/follow_bodies_blends.h"
#include "ringlet_shaders/follow_bodies_plain.h"
#include "ringlet_shaders/follow_core_plain.h"
#include "ringlet_shaders/follow_frames_plain.h"
#include "ringlet_shaders/follow_hairs_among_bodies.h"
#include "ringlet_shaders/follow_hairs_blends.h"
#include "ringlet_shaders/follow_hairs_blends_among_bodies.h"
#include "ringlet_shaders/follow_hairs_plain.h"

namespace ringlet {
namespace {

struct Compiled {
  const char* name;
  std::span<const std::uint32_t> spirv;
};
// In the order of a frame.
std::vector<Compiled> compiled(bool hasBodies, bool isBlended) {
  std::vector<Compiled> all{{"follow_core", k_follow_core_plain}, {"follow_frames", k_follow_frames_plain}};
  const auto add = [&](const char* name, std::span<const std::uint32_t> plain,
                       std::span<const std::uint32_t> blends) {
    all.push_back({name, isBlended ? blends : plain});
  };
  if (!hasBodies) {
    add("follow_hairs", k_follow_hairs_plain, k_follow_hairs_blends);
  } else {
    add("follow_hairs", k_follow_hairs_among_bodies, k_follow_hairs_blends_among_bodies);
    add("follow_bodies", k_follow_bodies_plain, k_follow_bodies_blends);
  }
  return all;
}

// Which of `others_` holds which binding.
constexpr std::uint32_t kOthers[] = {layout::kBindCoreRows,     layout::kBindCoreWeights, layout::kBindCores,
                                     layout::kBindFollowGuides, layout::kBindCoreFrames,  layout::kBindCurls,
                                     layout::kBindOwnPoints,    layout::kBindFollowHairs};

std::vector<std::vector<CoreWeights>> weightsOf(std::span<const GuideRest> guides) {
  std::vector<std::vector<CoreWeights>> weights(guides.size());
  std::atomic<std::size_t> next = 0;
  inParallel(std::max(1u, std::thread::hardware_concurrency()), [&] {
    for (std::size_t g; (g = next++) < guides.size();) weights[g] = coreWeightsOf(guides[g]);
  });
  return weights;
}

layout::FollowHair recordOf(const FollowHair& hair, std::uint32_t firstPoint, Vec3f rootOffset) {
  return {.offset = {hair.offset.x, hair.offset.y, hair.offset.z},
          .guide = hair.guide,
          .phase = hair.phase,
          .radius = hair.radius,
          .lengthShare = hair.length,
          .spread = hair.spread,
          .firstPoint = firstPoint,
          .rootOffset = {rootOffset.x, rootOffset.y, rootOffset.z}};
}

bool followsSeveral(const FollowHair& hair) {
  return std::ranges::any_of(hair.others, [](const FollowHair::Other& other) { return other.share > 0; });
}

layout::FollowBlend blendOf(const FollowHair& hair) {
  layout::FollowBlend blend{};
  for (std::size_t k = 0; k < hair.others.size(); ++k) {
    const FollowHair::Other& other = hair.others[k];
    // A guide that counts for nothing may be any: it is looked up all the same.
    blend.guides[k] = other.share > 0 ? other.guide : hair.guide;
    blend.offsets[k] = packed(Vec3d(other.offset), static_cast<double>(other.share));
  }
  return blend;
}

}  // namespace

Status FollowStage::makeGuides(gpu::Device& device, std::span<const GuideRest> guides) {
  std::vector<layout::CoreRow> rows;
  std::vector<layout::vec4> records;
  std::vector<layout::FollowGuide> constants;
  const auto weights = weightsOf(guides);
  for (std::size_t g = 0; g < guides.size(); ++g) {
    const auto first = static_cast<std::uint32_t>(rows.size());
    for (const CoreWeights& row : weights[g]) {
      const std::size_t particle = rows.size() - first;
      const auto recordCount = static_cast<std::uint32_t>((row.weights.size() + 3) / 4);
      rows.push_back({.firstParticle = first + static_cast<std::uint32_t>(row.first),
                      .firstRecord = static_cast<std::uint32_t>(records.size()),
                      .recordCount = recordCount,
                      .beginsPiece = guides[g].beginsPiece(particle) ? 1u : 0u});
      std::vector<float> padded = row.weights;
      padded.resize(4 * static_cast<std::size_t>(recordCount));
      for (std::size_t k = 0; k < padded.size(); k += 4)
        records.push_back({padded[k], padded[k + 1], padded[k + 2], padded[k + 3]});
    }
    constants.push_back({.restFrame = packed(quaternionOf(guides[g].frame)),
                         .firstParticle = first,
                         .particleCount = static_cast<std::uint32_t>(rows.size()) - first,
                         .unused = {}});
  }
  const std::uint64_t vectors = std::uint64_t{particleCount_} * sizeof(layout::vec4);
  auto add = [&](Result<gpu::Buffer> buffer) -> Status {
    if (!buffer) return buffer.error();
    others_.push_back(std::move(*buffer));
    return {};
  };
  for (Status made :
       {add(createFilled(device, rows, "rows of cores")),
        add(createFilled(device, records, "weights of cores")),
        add(createZero(device, vectors, "cores of guides")), add(createFilled(device, constants, "guides")),
        add(createZero(device, vectors, "frames of guides")),
        add(createZero(device, vectors, "curls of guides"))})
    if (!made) return made;
  return {};
}

Status FollowStage::makeOwnPoints(gpu::Device& device, const OwnPoints& own) {
  std::vector<layout::vec4> records;
  for (const OwnPoint& point : own.points)
    records.push_back(packed(Vec3d(point.shift), static_cast<double>(point.along)));
  if (records.empty()) records.push_back({});
  auto filled = createFilled(device, records, "shapes of hairs");
  if (!filled) return filled.error();
  others_.push_back(std::move(*filled));
  return {};
}

Status FollowStage::makeHairs(gpu::Device& device, std::span<const FollowHair> hairs) {
  std::vector<layout::FollowHair> records;
  for (std::size_t h = 0; h < hairs.size(); ++h) records.push_back(recordOf(hairs[h], firstPoint_[h], {}));
  records.push_back({});
  records.back().firstPoint = firstPoint_.back();
  auto filled = createFilled(device, records, "hairs");
  if (!filled) return filled.error();
  others_.push_back(std::move(*filled));
  if (std::ranges::none_of(hairs, followsSeveral)) return {};
  std::vector<layout::FollowBlend> blends;
  for (const FollowHair& hair : hairs) blends.push_back(blendOf(hair));
  auto blended = createFilled(device, blends, "other guides of hairs");
  if (!blended) return blended.error();
  blends_.emplace(std::move(*blended));
  return {};
}

Status FollowStage::makeInside(gpu::Device& device) {
  if (bodies_.count() == 0) return {};
  const layout::InsideCount nothing{.indirect = {0, 1, 1}, .points = 0};
  auto none = createFilled(device, std::span(&nothing, 1), "no points inside bodies");
  if (!none) return none.error();
  auto count = createZero(device, sizeof(nothing), "number of points inside bodies");
  if (!count) return count.error();
  auto points = gpu::Buffer::create(device, std::uint64_t{pointCount_} * sizeof(std::uint32_t),
                                    gpu::BufferKind::storage, "points inside bodies");
  if (!points) return points.error();
  inside_.emplace(Inside{std::move(*count), std::move(*none), std::move(*points)});
  return {};
}

Status FollowStage::makeKernels(gpu::Device& device, bool isOnScalp, bool areCut, bool haveOwn) {
  gpu::BufferTable table = bodies_.bufferTable();
  const auto bind = [&](std::uint32_t number, const gpu::Buffer& buffer) {
    table.emplace(number, buffer);
    table.emplace(layout::kFollowTexels + number, buffer);
  };
  bind(layout::kBindGuidePoints, positions_);
  bind(layout::kBindHairPoints, points_);
  for (std::size_t i = 0; i < others_.size(); ++i) bind(kOthers[i], others_[i]);
  if (blends_) bind(layout::kBindFollowBlends, *blends_);
  if (inside_) {
    bind(layout::kBindInsideCount, inside_->count);
    bind(layout::kBindInsidePoints, inside_->points);
  }
  const bool texels = std::ranges::all_of(
      table, [&](const auto& entry) { return isSeenAsTexels(device, entry.second.get().bytes()); });
  for (const auto& [name, spirv] : compiled(bodies_.count() > 0, blends_.has_value())) {
    gpu::KernelDescription description;
    description.name = name;
    description.spirv = spirv;
    description.remedy = "take another device, or fewer hairs";
    description.pushConstantBytes = sizeof(layout::FollowParameters);
    description.constants = {{layout::kSpecGroupSize, device.pointGroupSize()},
                             {layout::kSpecTexels, texels ? 1u : 0u},
                             {layout::kSpecOnScalp, isOnScalp ? 1u : 0u},
                             {layout::kSpecCutGuides, areCut ? 1u : 0u},
                             {layout::kSpecOwnPoints, haveOwn ? 1u : 0u}};
    description.groupSize = device.pointGroupSize();
    auto kernel = gpu::BoundKernel::create(device, description, table);
    if (!kernel) return kernel.error();
    kernels_.push_back(std::move(*kernel));
  }
  return {};
}

Result<FollowStage> FollowStage::create(gpu::Device& device, std::span<const GuideRest> guides,
                                        std::span<const FollowHair> hairs, std::span<const Body> bodies,
                                        bool isOnScalp, const OwnPoints& own) {
  std::uint64_t particles = 0, points = 0;
  for (const GuideRest& guide : guides) particles += guide.arcs.size();
  std::size_t stride = 0;
  for (std::size_t h = 0; h < hairs.size(); ++h) {
    const std::size_t count = pointCountOf(hairs[h], guides, own.of(h));
    stride = std::max(stride, count);
    points += count;
  }
  const std::uint64_t most =
      std::min<std::uint64_t>(device.properties().maxStorageBufferRange / 16,
                              std::uint64_t{device.properties().maxGroupCount} * device.pointGroupSize());
  if (points > most || hairs.size() * stride > std::min<std::uint64_t>(most, layout::kHairEnd))
    return Error{
        fmt::format("{} hairs have {} points; the device {} sees at most {} at once, of {} such hairs",
                    hairs.size(), points, device.properties().name, most,
                    std::min<std::uint64_t>(most, layout::kHairEnd) / std::max<std::size_t>(stride, 1))};

  auto positions = gpu::Buffer::create(device, particles * sizeof(layout::vec4), gpu::BufferKind::storage,
                                       "particles of guides");
  if (!positions) return positions.error();
  auto out = gpu::Buffer::create(device, points * sizeof(layout::uvec4), gpu::BufferKind::storage,
                                 "points of hairs");
  if (!out) return out.error();
  auto posed = PosedBodies::create(device, bodies);
  if (!posed) return posed.error();
  FollowStage self(std::move(*positions), std::move(*out), std::move(*posed));
  self.guideCount_ = static_cast<std::uint32_t>(guides.size());
  self.particleCount_ = static_cast<std::uint32_t>(particles);
  self.hairCount_ = static_cast<std::uint32_t>(hairs.size());
  self.pointCount_ = static_cast<std::uint32_t>(points);
  self.stride_ = static_cast<std::uint32_t>(stride);
  for (std::size_t h = 0; h < hairs.size(); ++h)
    self.firstPoint_.push_back(self.firstPoint_.back() +
                               static_cast<std::uint32_t>(pointCountOf(hairs[h], guides, own.of(h))));
  if (Status made = self.makeGuides(device, guides); !made) return made.error();
  if (Status made = self.makeOwnPoints(device, own); !made) return made.error();
  if (Status made = self.makeHairs(device, hairs); !made) return made.error();
  if (isOnScalp) {
    self.onScalp_.assign(hairs.begin(), hairs.end());
    std::uint32_t first = 0;
    for (const GuideRest& guide : guides)
      self.guideRoots_.push_back(std::exchange(first, first + static_cast<std::uint32_t>(guide.arcs.size())));
  }
  const bool areCut =
      std::ranges::any_of(guides, [](const GuideRest& guide) { return !guide.pieces.empty(); });
  if (Status made = self.makeInside(device); !made) return made.error();
  if (Status made = self.makeKernels(device, isOnScalp, areCut, !own.empty()); !made) return made.error();
  return self;
}

Status FollowStage::setPose(std::span<const Vec3d> positions, std::span<const Vec3d> roots,
                            std::span<const std::uint32_t> cutBeyond) {
  std::vector<layout::vec4> records;
  records.reserve(positions.size());
  for (const Vec3d& position : positions) records.push_back(packed(position));
  for (const std::uint32_t particle : cutBeyond) records[particle].w = -1;
  if (Status done = positions_.upload(std::as_bytes(std::span(records))); !done) return done;
  std::vector<Vec3d> guideRoots;
  for (const std::uint32_t particle : guideRoots_) guideRoots.push_back(positions[particle]);
  return setRoots(roots, guideRoots);
}

Status FollowStage::setRoots(std::span<const Vec3d> roots, std::span<const Vec3d> guideRoots) {
  RINGLET_ASSERT(roots.size() == onScalp_.size(), "hairs on a scalp have a root each");
  if (roots.empty()) return {};
  std::vector<layout::FollowHair> hairs;
  hairs.reserve(roots.size());
  for (std::size_t h = 0; h < roots.size(); ++h)
    hairs.push_back(recordOf(onScalp_[h], firstPoint_[h], Vec3f(roots[h] - guideRoots[onScalp_[h].guide])));
  return others_.back().upload(std::as_bytes(std::span(hairs)));
}

void FollowStage::record(gpu::CommandList& list, Quatd head) {
  bodies_.record(list);
  layout::FollowParameters parameters{.head = packed(head),
                                      .count = 0,
                                      .stride = stride_,
                                      .particles = particleCount_,
                                      .bodyCount = bodies_.metCount()};
  if (inside_) list.copyBuffer(inside_->none, inside_->count, sizeof(layout::InsideCount));
  const std::uint32_t counts[] = {particleCount_, guideCount_, hairCount_};
  const std::uint32_t invocations[] = {particleCount_, guideCount_, hairCount_ * stride_};
  for (std::size_t k = 0; k < std::size(counts); ++k) {
    parameters.count = counts[k];
    kernels_[k].dispatch(list, parameters, invocations[k]);
    list.barrier();
  }
  if (!inside_) return;
  kernels_.back().dispatchIndirect(list, parameters, inside_->count, offsetof(layout::InsideCount, indirect));
  list.barrier();
}

std::uint64_t FollowStage::byteCount() const {
  std::uint64_t bytes = positions_.bytes() + points_.bytes() + bodies_.byteCount();
  for (const gpu::Buffer& buffer : others_) bytes += buffer.bytes();
  if (blends_) bytes += blends_->bytes();
  if (inside_) bytes += inside_->count.bytes() + inside_->none.bytes() + inside_->points.bytes();
  return bytes;
}

}  // namespace ringlet
