// What is seen at each sample: the nearest. A sample holds nearness (near / distance, as bits, which order as numbers
// do)
// and what it is of; the greater pair wins, so that a cleared sample holds nothing and the order of drawing does not
// count.
// Where a device has no 64-bit atomics, one pass finds the nearness and a second what has it: the same bits.
#ifndef RINGLET_VISIBLE
#define RINGLET_VISIBLE

#include "shared/picture.glsl"

#ifdef RINGLET_ATOMIC64
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require
layout(set = 0, binding = kBindSamples) buffer Samples { uint64_t samples[]; };

void show(uint at, float nearness, uint what) {
  uint64_t key = uint64_t(floatBitsToUint(nearness)) << 32 | uint64_t(what);
  if (samples[at] < key) atomicMax(samples[at], key);
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
