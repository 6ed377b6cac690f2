// Implements render/stretch_colours.h.
#include "ringlet/render/stretch_colours.h"

#include <algorithm>
#include <utility>

#include "layout/picture.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet_shaders/render_stretch_plain.h"

namespace ringlet {
namespace {

constexpr double kLeastEdge = 1e-9;  // [m]: edges without a length at rest are not stretched

}  // namespace

Result<StretchColours> StretchColours::create(gpu::Device& device, const gpu::Buffer& points,
                                              std::span<const Vec3d> rest,
                                              std::span<const std::uint32_t> firstPoint,
                                              std::span<const std::uint32_t> strandOf,
                                              const gpu::Buffer& drawn) {
  std::vector<float> lengths(rest.size(), 1e9f);
  for (std::size_t i = 0; i + 1 < rest.size(); ++i) {
    const double edge = length(rest[i + 1] - rest[i]);
    if (edge > kLeastEdge) lengths[i] = static_cast<float>(edge);
  }
  std::vector<layout::StretchStrand> strands;
  for (const std::uint32_t s : strandOf)
    strands.push_back({firstPoint[s], firstPoint[s + 1] - firstPoint[s]});
  auto lengthBuffer = createFilled(device, lengths, "edges at rest");
  if (!lengthBuffer) return lengthBuffer.error();
  auto strandBuffer = createFilled(device, strands, "strands of hairs");
  if (!strandBuffer) return strandBuffer.error();
  StretchColours self(std::move(*lengthBuffer), std::move(*strandBuffer));
  self.hairCount_ = static_cast<std::uint32_t>(strandOf.size());

  gpu::KernelDescription description;
  description.name = "render_stretch";
  description.spirv = k_render_stretch_plain;
  description.pushConstantBytes = sizeof(layout::StretchParameters);
  description.groupSize = device.pointGroupSize();
  description.constants = {{layout::kSpecGroupSize, description.groupSize}};
  auto kernel = gpu::BoundKernel::create(device, description,
                                         {{layout::kBindStretchPoints, points},
                                          {layout::kBindStretchLengths, self.lengths_},
                                          {layout::kBindStretchStrands, self.strands_},
                                          {layout::kBindStretchHairs, drawn}});
  if (!kernel) return kernel.error();
  self.kernel_.emplace(std::move(*kernel));
  return self;
}

void StretchColours::record(gpu::CommandList& list, double most) const {
  kernel_->dispatch(list, layout::StretchParameters{.count = hairCount_, .most = static_cast<float>(most)},
                    hairCount_);
  list.barrier();
}

}  // namespace ringlet
