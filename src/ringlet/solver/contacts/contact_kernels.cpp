// Implements solver/contacts/contact_kernels.h.
#include "ringlet/solver/contacts/contact_kernels.h"

#include <span>

#include "layout/contacts.h"
#include "ringlet_shaders/contact_check_plain.h"
#include "ringlet_shaders/contact_count_plain.h"
#include "ringlet_shaders/contact_gather_plain.h"
#include "ringlet_shaders/contact_judge_plain.h"
#include "ringlet_shaders/contact_life_plain.h"
#include "ringlet_shaders/contact_motion_plain.h"
#include "ringlet_shaders/contact_order_plain.h"
#include "ringlet_shaders/contact_query_plain.h"
#include "ringlet_shaders/contact_sample_plain.h"
#include "ringlet_shaders/contact_scan_plain.h"
#include "ringlet_shaders/contact_scatter_plain.h"
#include "ringlet_shaders/contact_system_plain.h"
#include "ringlet_shaders/contact_touch_plain.h"
#include "ringlet_shaders/contact_touch_time.h"

namespace ringlet {
namespace {

struct Compiled {
  const char* name;
  std::span<const std::uint32_t> spirv;
};

// In the order of ContactKernel, for the distance taper.
const Compiled kCompiled[contactKernelCount(ContactTaper::distance)] = {
    {"contact_motion", k_contact_motion_plain}, {"contact_count", k_contact_count_plain},
    {"contact_scan", k_contact_scan_plain},     {"contact_scatter", k_contact_scatter_plain},
    {"contact_order", k_contact_order_plain},   {"contact_sample", k_contact_sample_plain},
    {"contact_query", k_contact_query_plain},   {"contact_touch", k_contact_touch_plain},
    {"contact_system", k_contact_system_plain}, {"contact_judge", k_contact_judge_plain},
};

const Compiled& compiledOf(ContactKernel which, ContactTaper taper) {
  static const Compiled touch{"contact_touch", k_contact_touch_time},
      life{"contact_life", k_contact_life_plain}, check{"contact_check", k_contact_check_plain},
      gather{"contact_gather", k_contact_gather_plain};
  if (taper == ContactTaper::time) {
    if (which == ContactKernel::touch) return touch;
    if (which == ContactKernel::life) return life;
    if (which == ContactKernel::check) return check;
    if (which == ContactKernel::next) return gather;
  }
  return kCompiled[static_cast<std::size_t>(which)];
}

}  // namespace

gpu::KernelDescription describeContactKernel(ContactKernel which, const ContactKernelForm& form) {
  const Compiled& compiled = compiledOf(which, form.taper);
  gpu::KernelDescription description;
  description.name = compiled.name;
  description.spirv = compiled.spirv;
  description.remedy = "take another device, or leave out contacts";
  description.pushConstantBytes = sizeof(layout::ContactParameters);
  description.constants = {{layout::kSpecGroupSize, form.groupSize},
                           {layout::kSpecTexels, form.texels ? 1u : 0u},
                           {layout::kSpecInGroups, form.inGroups ? 1u : 0u},
                           {layout::kSpecDivided, form.divided ? 1u : 0u},
                           {layout::kSpecForGpu, form.forGpu ? 1u : 0u}};
  description.groupSize = form.groupSize;
  return description;
}

}  // namespace ringlet
