// Finds what is visible at each sample: the nearest. A sample holds nearness (near / distance, as bits, which
// have the same order as the numbers) and what it belongs to. The larger pair wins, so that a cleared sample
// holds nothing, and the order of drawing does not matter. On devices without 64-bit atomics one pass finds
// the nearness and a second one what has it, with the same bits.
#ifndef RINGLET_VISIBLE
#define RINGLET_VISIBLE

#include "shared/picture.glsl"

#ifdef RINGLET_ATOMIC64
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require
layout(set = 0, binding = kBindSamples) buffer Samples { uint64_t samples[]; };

layout(set = 0, binding = kRenderTexels + kBindSamples) uniform usamplerBuffer sampleTexels;

/// The nearness at a sample some time ago. It can only be too small, so what it hides is hidden; this is true
/// of most, and saves the atomic.
uint nearnessBefore(uint at) {
  if (!kTexels) return uint(samples[at] >> 32);
  uvec4 two = recordAt(sampleTexels, at >> 1);
  return (at & 1u) != 0 ? two.w : two.y;
}

void show(uint at, float nearness, uint what) {
  uint bits = floatBitsToUint(nearness);
  if (nearnessBefore(at) <= bits) atomicMax(samples[at], uint64_t(bits) << 32 | uint64_t(what));
}
#else
layout(constant_id = kSpecPass) const uint kPass = 0;
layout(set = 0, binding = kBindSamples) buffer Samples { uint sampleWords[]; };

void show(uint at, float nearness, uint what) {
  uint bits = floatBitsToUint(nearness);
  if (kPass == 0) {
    if (sampleWords[2 * at + 1] < bits) atomicMax(sampleWords[2 * at + 1], bits);
  } else if (sampleWords[2 * at + 1] == bits) {
    atomicMax(sampleWords[2 * at], what);
  }
}
#endif
#endif
