// Implements render/render_kernels.h.
#include "ringlet/render/render_kernels.h"

#include <span>

#include "layout/picture.h"
#include "ringlet_shaders/render_compact_plain.h"
#include "ringlet_shaders/render_compact_preview.h"
#include "ringlet_shaders/render_filter_plain.h"
#include "ringlet_shaders/render_hairs_atomic64.h"
#include "ringlet_shaders/render_hairs_plain.h"
#include "ringlet_shaders/render_openness_plain.h"
#include "ringlet_shaders/render_resolve_plain.h"
#include "ringlet_shaders/render_resolve_preview.h"
#include "ringlet_shaders/render_shade_hairs_plain.h"
#include "ringlet_shaders/render_shade_solids_plain.h"
#include "ringlet_shaders/render_shade_solids_preview.h"
#include "ringlet_shaders/render_shadow_hairs_plain.h"
#include "ringlet_shaders/render_shadow_solids_plain.h"
#include "ringlet_shaders/render_shadow_sum_plain.h"
#include "ringlet_shaders/render_solids_atomic64.h"
#include "ringlet_shaders/render_solids_plain.h"
#include "ringlet_shaders/render_tone_plain.h"

namespace ringlet {
namespace {

struct Compiled {
  const char* name;
  std::span<const std::uint32_t> spirv;
};

// As RenderKernel counts them.
const Compiled kCompiled[kRenderKernelCount] = {
    {"render_shadow_hairs", k_render_shadow_hairs_plain},
    {"render_shadow_solids", k_render_shadow_solids_plain},
    {"render_shadow_sum", k_render_shadow_sum_plain},
    {"render_openness", k_render_openness_plain},
    {"render_solids", k_render_solids_plain},
    {"render_hairs", k_render_hairs_plain},
    {"render_solids_id", k_render_solids_plain},
    {"render_hairs_id", k_render_hairs_plain},
    {"render_compact", k_render_compact_plain},
    {"render_shade_hairs", k_render_shade_hairs_plain},
    {"render_shade_solids", k_render_shade_solids_plain},
    {"render_resolve", k_render_resolve_plain},
    {"render_filter", k_render_filter_plain},
    {"render_tone", k_render_tone_plain},
};

}  // namespace

gpu::KernelDescription describeRenderKernel(RenderKernel which, std::uint32_t groupSize, bool hasAtomic64,
                                            bool texels, bool isPreview) {
  const Compiled& compiled = kCompiled[static_cast<std::size_t>(which)];
  gpu::KernelDescription description;
  description.name = compiled.name;
  description.spirv = compiled.spirv;
  description.remedy = "take another device";
  description.pushConstantBytes = sizeof(layout::PictureBand);
  description.constants = {{layout::kSpecGroupSize, groupSize}, {layout::kSpecTexels, texels ? 1u : 0u}};
  description.groupSize = groupSize;
  const bool isId = which == RenderKernel::solidsId || which == RenderKernel::hairsId;
  if (!hasAtomic64) {
    description.constants.push_back({layout::kSpecPass, isId ? 1u : 0u});
  } else if (which == RenderKernel::solids) {
    description.spirv = k_render_solids_atomic64;
  } else if (which == RenderKernel::hairs) {
    description.spirv = k_render_hairs_atomic64;
  }
  if (isPreview && which == RenderKernel::compact) description.spirv = k_render_compact_preview;
  if (isPreview && which == RenderKernel::shadeSolids) description.spirv = k_render_shade_solids_preview;
  if (isPreview && which == RenderKernel::resolve) description.spirv = k_render_resolve_preview;
  return description;
}

}  // namespace ringlet
