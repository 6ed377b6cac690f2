// Implements render/strand_points.h.
#include "ringlet/render/strand_points.h"

#include <bit>
#include <utility>

#include "layout/hair_points.h"

namespace ringlet {

Result<StrandPoints> StrandPoints::create(gpu::Device& device, std::vector<std::uint32_t> firstPoint) {
  auto points = gpu::Buffer::create(device, std::uint64_t{firstPoint.back()} * sizeof(layout::uvec4),
                                    gpu::BufferKind::storage, "points of strands");
  if (!points) return points.error();
  return StrandPoints(std::move(*points), std::move(firstPoint));
}

Status StrandPoints::setPose(std::span<const Vec3f> points, double metresPerUnit,
                             std::span<const std::uint32_t> cutBeyond) {
  std::vector<layout::uvec4> records;
  records.reserve(points.size());
  const auto bitsOf = [&](float x) {
    return std::bit_cast<std::uint32_t>(static_cast<float>(x * metresPerUnit));
  };
  for (std::uint32_t strand = 0; strand + 1 < firstPoint_.size(); ++strand) {
    for (std::uint32_t i = firstPoint_[strand]; i < firstPoint_[strand + 1]; ++i) {
      const bool isEnd = i + 1 == firstPoint_[strand + 1];
      records.push_back({bitsOf(points[i].x), bitsOf(points[i].y), bitsOf(points[i].z),
                         isEnd ? strand | layout::kHairEnd : strand});
    }
  }
  for (const std::uint32_t i : cutBeyond) records[i].w |= layout::kHairEnd;
  return points_.upload(std::as_bytes(std::span(records)));
}

}  // namespace ringlet
