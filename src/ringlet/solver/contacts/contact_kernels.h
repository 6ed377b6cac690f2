// The compiled contact kernels (shaders/kernels/contact_*.comp), by their place in a step.
#pragma once

#include <cstddef>
#include <cstdint>

#include "ringlet/gpu/kernel.h"
#include "ringlet/scene/contact_settings.h"

namespace ringlet {

/// In the order of a step; the kernels are contact_motion.comp and so on. The first solve with contacts of a
/// step is prepared by `touch` (with the time taper also by `life`), later ones by `next`:
/// contact_system.comp, with the time taper contact_gather.comp.
enum class ContactKernel {
  motion,
  count,
  scan,
  scatter,
  order,
  sample,
  query,
  touch,
  next,
  judge,  // after sample; only if strands are divided among devices
  life,   // after touch, with the time taper
  check   // after life
};
/// Number of these kernels.
constexpr std::size_t contactKernelCount(ContactTaper taper) {
  const auto life = static_cast<std::size_t>(ContactKernel::life);
  return taper == ContactTaper::time ? life + 2 : life;
}

/// Invocations per workgroup.
inline constexpr std::uint32_t kContactGroupSize = 64;

struct ContactKernelForm {
  ContactTaper taper = ContactTaper::distance;
  std::uint32_t groupSize = kContactGroupSize;
  bool inGroups = false;  // some strands do not meet pair by pair, see VolumeStrands
  bool texels = false;    // records are read as texels (gpu::BindingKind)
  bool forGpu = false;    // the form for GPUs
  bool divided = false;   // other devices step some of the strands
};

gpu::KernelDescription describeContactKernel(ContactKernel which, const ContactKernelForm& form);

}  // namespace ringlet
