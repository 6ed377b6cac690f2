// The compiled kernels of pictures (shaders/kernels/render_*.comp), in the order of a picture.
#pragma once

#include <cstddef>
#include <cstdint>

#include "ringlet/gpu/kernel.h"

namespace ringlet {

enum class RenderKernel {
  shadowHairs,
  shadowSolids,
  shadowSum,
  openness,
  solids,    // what is seen of bodies; without 64-bit atomics their nearness,
  hairs,     // and of hair;
  solidsId,  // then what is nearest: only without 64-bit atomics
  hairsId,
  compact,
  shadeHairs,
  shadeSolids,
  resolve,
  filter,
  tone,
};
inline constexpr std::size_t kRenderKernelCount = 14;

/// hasAtomic64: of the device. texels: points and triangles are read as texels. isPreview: as
/// PictureSize::isPreview; there are no `filter` and `tone` then.
gpu::KernelDescription describeRenderKernel(RenderKernel which, std::uint32_t groupSize, bool hasAtomic64,
                                            bool texels, bool isPreview);

}  // namespace ringlet
