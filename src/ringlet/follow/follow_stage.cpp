// Implements follow/follow_stage.h.
#include "ringlet/follow/follow_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <thread>
#include <utility>

#include "ringlet/base/in_parallel.h"
#include "ringlet/follow/core_weights.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet_shaders/follow_core_plain.h"
#include "ringlet_shaders/follow_frames_plain.h"
#include "ringlet_shaders/follow_hairs_plain.h"
#include "shared/layout.h"

namespace ringlet {
namespace {

constexpr std::uint32_t kMostInGroup =
    256;  // 65,535 groups, the least Vulkan promises, are 16 million points

struct Compiled {
  const char* name;
  std::span<const std::uint32_t> spirv;
};
const Compiled kCompiled[] = {{"follow_core", k_follow_core_plain},
                              {"follow_frames", k_follow_frames_plain},
                              {"follow_hairs", k_follow_hairs_plain}};

// Which of `others_` holds which binding.
constexpr std::uint32_t kOthers[] = {layout::kBindCoreRows,     layout::kBindCoreWeights, layout::kBindCores,
                                     layout::kBindFollowGuides, layout::kBindCoreFrames,  layout::kBindCurls,
                                     layout::kBindFollowHairs};

layout::vec4 vec4Of(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0};
}
layout::vec4 vec4Of(Quatd q) {
  return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z), static_cast<float>(q.w)};
}

std::vector<std::vector<CoreWeights>> weightsOf(std::span<const GuideRest> guides) {
  std::vector<std::vector<CoreWeights>> weights(guides.size());
  std::atomic<std::size_t> next = 0;
  inParallel(std::max(1u, std::thread::hardware_concurrency()), [&] {
    for (std::size_t g; (g = next++) < guides.size();) weights[g] = coreWeightsOf(guides[g]);
  });
  return weights;
}

std::uint32_t groupSizeOn(const gpu::Device& device) {
  return std::min(kMostInGroup, device.properties().maxGroupInvocations);
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
      const auto recordCount = static_cast<std::uint32_t>((row.weights.size() + 3) / 4);
      rows.push_back({.firstParticle = first + static_cast<std::uint32_t>(row.first),
                      .firstRecord = static_cast<std::uint32_t>(records.size()),
                      .recordCount = recordCount,
                      .unused = 0});
      std::vector<float> padded = row.weights;
      padded.resize(4 * static_cast<std::size_t>(recordCount));
      for (std::size_t k = 0; k < padded.size(); k += 4)
        records.push_back({padded[k], padded[k + 1], padded[k + 2], padded[k + 3]});
    }
    constants.push_back({.restFrame = vec4Of(quaternionOf(guides[g].frame)),
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

Status FollowStage::makeKernels(gpu::Device& device) {
  gpu::BufferTable table;
  const auto bind = [&](std::uint32_t number, const gpu::Buffer& buffer) {
    table.emplace(number, buffer);
    table.emplace(layout::kFollowTexels + number, buffer);
  };
  bind(layout::kBindGuidePoints, positions_);
  bind(layout::kBindHairPoints, points_);
  for (std::size_t i = 0; i < others_.size(); ++i) bind(kOthers[i], others_[i]);
  const bool texels = std::ranges::all_of(
      table, [&](const auto& entry) { return isSeenAsTexels(device, entry.second.get().bytes()); });
  for (const Compiled& compiled : kCompiled) {
    gpu::KernelDescription description;
    description.name = compiled.name;
    description.spirv = compiled.spirv;
    description.remedy = "take another device, or fewer hairs";
    description.pushConstantBytes = sizeof(layout::FollowParameters);
    description.constants = {{layout::kSpecGroupSize, groupSizeOn(device)},
                             {layout::kSpecTexels, texels ? 1u : 0u}};
    description.groupSize = groupSizeOn(device);
    auto kernel = gpu::Kernel::create(device, description);
    if (!kernel) return kernel.error();
    auto bindings = gpu::Bindings::create(**kernel, table);
    if (!bindings) return bindings.error();
    kernels_.push_back(std::move(*kernel));
    bindings_.push_back(std::move(*bindings));
  }
  return {};
}

Result<FollowStage> FollowStage::create(gpu::Device& device, std::span<const GuideRest> guides,
                                        std::span<const FollowHair> hairs) {
  std::uint64_t particles = 0, points = 0;
  std::size_t stride = 0;
  for (const GuideRest& guide : guides) {
    particles += guide.arcs.size();
    stride = std::max(stride, guide.arcs.size());
  }
  for (const FollowHair& hair : hairs) points += guides[hair.guide].arcs.size();
  const std::uint64_t most =
      std::min<std::uint64_t>(device.properties().maxStorageBufferRange / 16,
                              std::uint64_t{device.properties().maxGroupCount} * groupSizeOn(device));
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
  FollowStage self(std::move(*positions), std::move(*out));
  self.guideCount_ = static_cast<std::uint32_t>(guides.size());
  self.particleCount_ = static_cast<std::uint32_t>(particles);
  self.hairCount_ = static_cast<std::uint32_t>(hairs.size());
  self.pointCount_ = static_cast<std::uint32_t>(points);
  self.stride_ = static_cast<std::uint32_t>(stride);
  if (Status made = self.makeGuides(device, guides); !made) return made.error();

  std::vector<layout::FollowHair> records;
  self.firstPoint_ = {0};
  for (const FollowHair& hair : hairs) {
    records.push_back({.offset = {hair.offset.x, hair.offset.y, hair.offset.z},
                       .guide = hair.guide,
                       .phase = hair.phase,
                       .radius = hair.radius,
                       .lengthShare = hair.length,
                       .spread = hair.spread,
                       .firstPoint = self.firstPoint_.back(),
                       .unused = {}});
    self.firstPoint_.push_back(self.firstPoint_.back() +
                               static_cast<std::uint32_t>(guides[hair.guide].arcs.size()));
  }
  auto filled = createFilled(device, records, "hairs");
  if (!filled) return filled.error();
  self.others_.push_back(std::move(*filled));
  if (Status made = self.makeKernels(device); !made) return made.error();
  return self;
}

Status FollowStage::setPose(std::span<const Vec3d> positions) {
  std::vector<layout::vec4> packed;
  packed.reserve(positions.size());
  for (const Vec3d& position : positions) packed.push_back(vec4Of(position));
  return positions_.upload(std::as_bytes(std::span(packed)));
}

void FollowStage::record(gpu::CommandList& list, Quatd head) const {
  layout::FollowParameters parameters{
      .head = vec4Of(head), .count = 0, .stride = stride_, .particles = particleCount_};
  const std::uint32_t counts[] = {particleCount_, guideCount_, hairCount_};
  const std::uint32_t invocations[] = {particleCount_, guideCount_, hairCount_ * stride_};
  for (std::size_t k = 0; k < kernels_.size(); ++k) {
    parameters.count = counts[k];
    const std::uint32_t groupSize = kernels_[k]->groupSize();
    list.dispatch(*kernels_[k], bindings_[k], parameters, (invocations[k] + groupSize - 1) / groupSize);
    list.barrier();
  }
}

std::uint64_t FollowStage::byteCount() const {
  std::uint64_t bytes = positions_.bytes() + points_.bytes();
  for (const gpu::Buffer& buffer : others_) bytes += buffer.bytes();
  return bytes;
}

}  // namespace ringlet
