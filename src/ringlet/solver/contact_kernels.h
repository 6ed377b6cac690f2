// The compiled contact kernels (shaders/kernels/contact_*.comp), by their place in a step.
#pragma once

#include <cstddef>
#include <cstdint>

#include "ringlet/gpu/kernel.h"

namespace ringlet {

/// In the order of a step: contact_motion.comp and so on.
enum class ContactKernel {
  motion,
  decide,
  count,
  scan,
  sum,
  scatter,
  order,
  query,
  touch,
  life,
  check,
  gather
};
inline constexpr std::size_t kContactKernelCount = 12;

/// texels: records are read as texels (gpu::BindingKind).
gpu::KernelDescription describeContactKernel(ContactKernel which, std::uint32_t groupSize, bool texels);

}  // namespace ringlet
