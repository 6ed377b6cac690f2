// Samples of the picture as texels, for kernels that only read them: two to a texel, if the device's texel
// buffers can hold all of them.
#ifndef RINGLET_SAMPLE_TEXELS
#define RINGLET_SAMPLE_TEXELS

#include "layout/picture.h"
#include "shared/texels.glsl"

layout(set = 0, binding = kBindSamples) readonly buffer Samples { uvec2 samples[]; };
layout(set = 0, binding = kRenderTexels + kBindSamples) uniform usamplerBuffer sampleTexels;

uvec2 sampleAt(uint i) {
  if (!kTexels) return samples[i];
  uvec4 two = recordAt(sampleTexels, i >> 1);
  return (i & 1u) != 0 ? two.zw : two.xy;
}

#endif
