// The compiled kernels of hair as a volume (shaders/kernels/volume_*.comp), by their place in a step.
#pragma once

#include <cstddef>
#include <cstdint>

#include "ringlet/gpu/kernel.h"

namespace ringlet {

/// In the order of a step; from count to order only in steps that put particles into cells, bring only in
/// iterations after the first, gather and spread in each; take, mark and ask only where
/// strands are divided among devices.
enum class VolumeKernel {
  begin,
  box,
  count,
  scan,
  sum,
  start,
  scatter,
  order,
  bring,
  gather,
  spread,
  take,
  mark,
  ask
};
inline constexpr std::size_t kVolumeKernelCount = 14;
inline constexpr std::size_t kVolumeDividedKernelCount = 3;  // of them, the last

/// Invocations per workgroup.
inline constexpr std::uint32_t kVolumeGroupSize = 64;

/// texels: records are read as texels (gpu::BindingKind); divided: other devices step some of the strands.
gpu::KernelDescription describeVolumeKernel(VolumeKernel which, bool texels, bool divided = false);

}  // namespace ringlet
