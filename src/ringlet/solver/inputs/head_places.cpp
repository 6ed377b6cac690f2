// Implements solver/inputs/head_places.h.
#include "ringlet/solver/inputs/head_places.h"

#include <algorithm>
#include <utility>

#include "layout/strands.h"
#include "ringlet/gpu/device_buffers.h"

namespace ringlet {
namespace {

constexpr std::uint64_t kRowBytes = 32ull << 20;  // most bytes of positions in a row

// The smallest number of records, `count` or more, that ends at a valid buffer offset.
std::uint32_t stride(std::uint32_t count, std::uint64_t recordBytes, std::uint64_t alignment) {
  while (count * recordBytes % alignment != 0) ++count;
  return count;
}

}  // namespace

gpu::BufferTable HeadBuffers::bufferTable() const {
  using namespace layout;
  return {{kBindPositions, positions},      {kBindVelocities, velocities},     {kBindReports, reports},
          {kBindPositionTexels, positions}, {kBindVelocityTexels, velocities}, {kBindHeadPoseTexels, poses}};
}

Result<std::shared_ptr<HeadPlaces>> HeadPlaces::create(gpu::Device& device, const GroomChunk& part,
                                                       const GroomRecords& records, int heads) {
  // Only a buffer knows the alignment of its offsets.
  const auto sample = gpu::Buffer::create(device, 0, gpu::BufferKind::storage, "sample");
  if (!sample) return sample.error();
  const std::uint64_t alignment = sample->alignment();
  const HeadStrides strides{.particles = stride(part.particleCount(), sizeof(layout::vec4), alignment),
                            .strands = stride(part.strandCount(), sizeof(layout::StrandReport), alignment),
                            .stepPoses = stride(layout::kMaxStepPoses, sizeof(layout::StepPose), alignment)};
  const std::uint64_t bytes = std::max<std::uint64_t>(1, strides.particles * records.position);
  const std::uint64_t seen = device.properties().maxTexelRecords * sizeof(layout::vec4);
  std::uint64_t most = std::min(static_cast<std::uint64_t>(heads), kRowBytes / bytes);
  most = std::min(most, seen / (strides.stepPoses * sizeof(layout::StepPose)));
  if (bytes <= seen) most = std::min(most, seen / bytes);  // a head that fits texels must fit in a row
  if (most < 2) return std::shared_ptr<HeadPlaces>();
  return std::shared_ptr<HeadPlaces>(
      new HeadPlaces(device, part, records, strides, static_cast<std::uint32_t>(most)));
}

Result<HeadRow> HeadPlaces::makeRow() const {
  const auto make = [&](std::uint64_t bytes, const char* name) {
    return createZero(*device_, heads_ * bytes, name);
  };
  auto positions = make(strides_.particles * records_.position, "positions");
  if (!positions) return positions.error();
  auto velocities = make(strides_.particles * records_.velocity, "velocities");
  if (!velocities) return velocities.error();
  auto reports = make(strides_.strands * records_.report, "reports");
  if (!reports) return reports.error();
  auto poses = make(strides_.stepPoses * sizeof(layout::StepPose), "poses");
  if (!poses) return poses.error();
  return HeadRow{
      .part = part_,
      .records = records_,
      .buffers = {std::move(*positions), std::move(*velocities), std::move(*reports), std::move(*poses)},
      .strides = strides_,
      .isTaken = std::vector<bool>(heads_)};
}

// The part ends with the last head's own records, without the padding to the next head.
Result<HeadBuffers> HeadPlace::part(std::uint32_t heads) const {
  const HeadRow& row = *row_;
  const auto of = [&](const gpu::Buffer& whole, std::uint64_t record, std::uint32_t stride,
                      std::uint32_t count) {
    const std::uint64_t begin = std::uint64_t{number_} * stride;
    const std::uint64_t records = std::uint64_t{heads - 1} * stride + count;
    return gpu::Buffer::part(whole, begin * record, records * record, whole.name());
  };
  auto positions =
      of(row.buffers.positions, row.records.position, row.strides.particles, row.part.particleCount());
  if (!positions) return positions.error();
  auto velocities =
      of(row.buffers.velocities, row.records.velocity, row.strides.particles, row.part.particleCount());
  if (!velocities) return velocities.error();
  auto reports = of(row.buffers.reports, row.records.report, row.strides.strands, row.part.strandCount());
  if (!reports) return reports.error();
  auto poses = of(row.buffers.poses, sizeof(layout::StepPose), row.strides.stepPoses, layout::kMaxStepPoses);
  if (!poses) return poses.error();
  return HeadBuffers{std::move(*positions), std::move(*velocities), std::move(*reports), std::move(*poses)};
}

Result<HeadPlace> HeadPlaces::take() {
  const std::lock_guard lock(*guard_);
  const auto hasRoom = [](const auto& row) { return std::ranges::count(row->isTaken, false) > 0; };
  auto row = std::ranges::find_if(rows_, hasRoom);
  if (row == rows_.end()) {
    auto made = makeRow();
    if (!made) return made.error();
    row = rows_.insert(rows_.end(), std::make_shared<HeadRow>(std::move(*made)));
  }
  const auto number = std::ranges::find((*row)->isTaken, false) - (*row)->isTaken.begin();
  (*row)->isTaken[number] = true;
  const auto free = [guard = guard_, of = *row, number](void*) {
    const std::lock_guard again(*guard);
    of->isTaken[number] = false;
  };
  return HeadPlace(*row, static_cast<std::uint32_t>(number), std::shared_ptr<void>(nullptr, free));
}

}  // namespace ringlet
