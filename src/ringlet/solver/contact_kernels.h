// The compiled contact kernels (shaders/kernels/contact_*.comp), by their place in a step.
#pragma once

#include <cstddef>
#include <cstdint>

#include "ringlet/gpu/kernel.h"
#include "ringlet/scene/contact_settings.h"

namespace ringlet {

/// In the order of a step: contact_motion.comp and so on. What prepares the first iteration of a step's solve
/// and those after it is contact_system.comp with the distance taper, contact_life.comp and
/// contact_gather.comp with the time taper.
enum class ContactKernel {
  motion,
  decide,
  count,
  scan,
  sum,
  scatter,
  order,
  sample,
  judge,
  query,
  touch,
  first,
  check,
  next
};
inline constexpr std::size_t kContactKernelCount = 14;

/// Invocations of a workgroup.
inline constexpr std::uint32_t kContactGroupSize = 64;

/// besideVolume: some strands meet as a volume as well; texels: records are read as texels
/// (gpu::BindingKind).
gpu::KernelDescription describeContactKernel(ContactKernel which, ContactTaper taper, bool besideVolume,
                                             std::uint32_t groupSize, bool texels);

}  // namespace ringlet
