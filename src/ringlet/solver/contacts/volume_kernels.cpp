// Implements solver/contacts/volume_kernels.h.
#include "ringlet/solver/contacts/volume_kernels.h"

#include <span>

#include "layout/contacts.h"
#include "layout/volume.h"
#include "ringlet_shaders/volume_begin_plain.h"
#include "ringlet_shaders/volume_box_plain.h"
#include "ringlet_shaders/volume_bring_plain.h"
#include "ringlet_shaders/volume_count_plain.h"
#include "ringlet_shaders/volume_gather_plain.h"
#include "ringlet_shaders/volume_mean_plain.h"
#include "ringlet_shaders/volume_nodes_plain.h"
#include "ringlet_shaders/volume_order_plain.h"
#include "ringlet_shaders/volume_place_plain.h"
#include "ringlet_shaders/volume_rank_plain.h"
#include "ringlet_shaders/volume_scan_plain.h"
#include "ringlet_shaders/volume_spread_plain.h"
#include "ringlet_shaders/volume_start_plain.h"

namespace ringlet {
namespace {

struct Compiled {
  const char* name;
  std::span<const std::uint32_t> spirv;
};

// In the order of VolumeKernel.
const Compiled kCompiled[kVolumeKernelCount] = {
    {"volume_begin", k_volume_begin_plain},   {"volume_box", k_volume_box_plain},
    {"volume_count", k_volume_count_plain},   {"volume_scan", k_volume_scan_plain},
    {"volume_start", k_volume_start_plain},   {"volume_place", k_volume_place_plain},
    {"volume_rank", k_volume_rank_plain},     {"volume_order", k_volume_order_plain},
    {"volume_bring", k_volume_bring_plain},   {"volume_gather", k_volume_gather_plain},
    {"volume_nodes", k_volume_nodes_plain},   {"volume_mean", k_volume_mean_plain},
    {"volume_spread", k_volume_spread_plain},
};

}  // namespace

gpu::KernelDescription describeVolumeKernel(VolumeKernel which, bool texels, bool forGpu, bool divided) {
  const Compiled& compiled = kCompiled[static_cast<std::size_t>(which)];
  gpu::KernelDescription description;
  description.name = compiled.name;
  description.spirv = compiled.spirv;
  description.remedy = "take another device, or contacts by pairs (contacts.method explicit)";
  description.pushConstantBytes = sizeof(layout::VolumeParameters);
  description.constants = {{layout::kSpecGroupSize, kVolumeGroupSize},
                           {layout::kSpecTexels, texels ? 1u : 0u},
                           {layout::kSpecDivided, divided ? 1u : 0u},
                           {layout::kSpecForGpu, forGpu ? 1u : 0u}};
  description.groupSize = kVolumeGroupSize;
  return description;
}

}  // namespace ringlet
