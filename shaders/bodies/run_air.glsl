// Drag of the air on the particles of this lane's run. Included by kernels/strand_step.comp.
#ifndef RINGLET_RUN_AIR
#define RINGLET_RUN_AIR

#include "equations/air_drag.glsl"
#include "equations/frame.glsl"
#include "equations/turbulence.glsl"
#include "shared/air_buffers.glsl"
#include "shared/strand_run.glsl"

AirDrag drag[RUN];
vec3 tangent[RUN];  // unit vector, or zero
vec3 wind[RUN];     // relative to the head's translation [m/s]

// Uses positions and velocities at the step's start.
void feelAir(uint step) {
  StepAir air = stepAir(step);
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) wind[k] = air.wind.xyz;
  if (kTurbulent) {
    [[unroll]] for (uint wave = 0; wave < kWindWaves; ++wave) {
      WindWave mode = windWave(wave);
      float phase = air.phases[wave / 4][wave % 4];
      RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k)
        wind[k] += windOfMode(mode.wave.xyz, mode.amplitude.xyz, phase, p[k]);
    }
  }
  vec3 before = fromRootward(eHat[RUN - 1], 1);
  if (lane == 0) before = vec3(0);
  RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
    vec3 here = isEdge(k) ? eHat[k] : vec3(0);
    tangent[k] = directionOf((k > 0 ? eHat[max(k - 1, 0)] : before) + here);
    drag[k] = airDrag(v[k] - wind[k], tangent[k], numbers.dragStrength, numbers.dragAlong, stepSeconds());
  }
}

#endif
