// The compiled kernels of hair as a volume (shaders/kernels/volume_*.comp), by their place in a step.
#pragma once

#include <cstddef>
#include <cstdint>

#include "ringlet/gpu/kernel.h"

namespace ringlet {

/// In the order of a step; from count to order only in steps that put particles into cells, bring only in
/// iterations after the first, gather and spread in each.
enum class VolumeKernel { begin, box, count, scan, sum, start, scatter, order, bring, gather, spread };
inline constexpr std::size_t kVolumeKernelCount = 11;

/// Invocations of a workgroup.
inline constexpr std::uint32_t kVolumeGroupSize = 64;

/// texels: records are read as texels (gpu::BindingKind).
gpu::KernelDescription describeVolumeKernel(VolumeKernel which, bool texels);

}  // namespace ringlet
