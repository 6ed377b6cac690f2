// The air in the form of one thread per strand: drag on all of its particles. Included by
// kernels/strand_step_serial.comp; the lanes form has run_air.glsl.
#include "equations/air_drag.glsl"
#include "equations/turbulence.glsl"

// Along the strand at a particle: of length 1, or zero.
vec3 tangentAt(uint i) {
  return directionOf((i > 0 ? scratchOf(i - 1, kEdge) : vec3(0)) + (i + 1 < count ? scratchOf(i, kEdge) : vec3(0)));
}

// Drag and wind at the step's start.
void feelAir(uint step) {
  StepAir air = stepAir(step);
  for (uint i = 0; i < count; ++i) {
    vec3 wind = air.wind.xyz;
    if (kTurbulent) {
      for (uint k = 0; k < kWindWaves; ++k) {
        WindWave mode = windWave(k);
        wind += windOfMode(mode.wave.xyz, mode.amplitude.xyz, air.phases[k / 4][k % 4], position(i));
      }
    }
    AirDrag drag =
        airDrag(velocity(i) - headChange - wind, tangentAt(i), parameters.dragStrength, parameters.dragAlong,
            stepSeconds());
    scratch[slot(i, kDrag)] = vec4(drag.across, drag.along, 0, 0);
    setScratch(i, kDrag + 1, wind);
  }
}
