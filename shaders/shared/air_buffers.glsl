// The buffers of the air that hair moves in. Part of strand_buffers.glsl.
#ifndef RINGLET_AIR_BUFFERS
#define RINGLET_AIR_BUFFERS

#include "layout/bodies.h"
#include "shared/texels.glsl"

layout(set = 0, binding = kBindAir) readonly buffer Air { StepAir stepAirs[]; };
layout(set = 0, binding = kBindWindModes) readonly buffer WindWaves { WindWave windWaves[]; };
layout(set = 0, binding = kBindAirTexels) uniform usamplerBuffer airTexels;
layout(set = 0, binding = kBindWindModeTexels) uniform usamplerBuffer windWaveTexels;

StepAir stepAir(uint step) {
  if (!kTexels) return stepAirs[step];
  vec4 phases[3];
  [[unroll]] for (uint k = 0; k < 3; ++k) phases[k] = vectorAt(airTexels, 4 * step + 1 + k);
  return StepAir(vectorAt(airTexels, 4 * step), phases);
}
WindWave windWave(uint k) {
  if (!kTexels) return windWaves[k];
  return WindWave(vectorAt(windWaveTexels, 2 * k), vectorAt(windWaveTexels, 2 * k + 1));
}

#endif
