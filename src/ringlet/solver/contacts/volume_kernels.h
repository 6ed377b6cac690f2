// The compiled kernels of hair as a volume (shaders/kernels/volume_*.comp), by their place in a step.
#pragma once

#include <cstddef>
#include <cstdint>

#include "ringlet/gpu/kernel.h"

namespace ringlet {

/// In the order of a step. Box to order run only in steps that sort particles into cells; bring only in
/// iterations after the first; gather to spread in every iteration; mean only if strands are divided among
/// devices.
enum class VolumeKernel {
  begin,
  box,
  count,
  scan,
  start,
  place,
  rank,
  order,
  bring,
  gather,
  nodes,
  mean,
  spread
};
inline constexpr std::size_t kVolumeKernelCount = 13;

/// Invocations per workgroup.
inline constexpr std::uint32_t kVolumeGroupSize = 64;

/// texels: records are read as texels (gpu::BindingKind); forGpu: the form for GPUs; divided: other devices
/// step some of the strands.
gpu::KernelDescription describeVolumeKernel(VolumeKernel which, bool texels, bool forGpu,
                                            bool divided = false);

}  // namespace ringlet
