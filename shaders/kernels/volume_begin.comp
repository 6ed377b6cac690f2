// Begins a step of the volume. Advances the displacement that each particle remembers: it decays, and grows by the
// particle's motion in the head's frame. Computes what the particle contributes to the nodes in the first iteration,
// from the guessed velocity, as in contact_motion.comp; and the box of cells that holds all particles. Mirrored by
// reference/kernels/volume_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

void main() {
  uint i;
  if (!findParticle(i)) return;
  VolumeParticle self = volumeParticle(i);
  vec4 memory = memoryOf(i);
  vec4 predicted = predictedOf(i);
  bool isKnown = predicted.w > 0.0;
  vec3 v = velocityOf(self.particle);
  vec3 x = positionOf(self.particle);
  vec3 place = inHeadFrame(x);
  vec3 s = isKnown ? fadedDisplacement(memory.xyz, place - placeOf(i).xyz, parameters.kept) : vec3(0);
  vec3 change = isKnown ? lastVelocityOf(self.particle) - predicted.xyz : vec3(0);
  float mass = self.mass * othersShare(self.ownDensity, memory.w);
  vec4 rate = rateFrom(mass, v + parameters.warmth * change, x, s);
  states[i] = VolumeState(vec4(s, memory.w), vec4(place, mass), vec4(v, 1));
  bool sorts = control.untilSort == 0;
  if (sorts) {
    brought[i] = rate;
    if (self.mass > 0.0) reachTo(place);  // what was cut off has none: it is of the volume no more
  } else {
    parcels[locatedAt(i).w].rate = rate;
  }
}
