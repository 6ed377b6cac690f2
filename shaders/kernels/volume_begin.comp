// What a particle of the volume remembers, a step on: its displacement fades and grows by how far it came in the
// head's frame; what it brings to the nodes in the first iteration, from the velocity its solve is guessed to have, as
// in contact_motion.comp; and how far the cells reach that all of them are in. Mirrored by
// reference/kernels/volume_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

void reach(int axis, int cell) {
  // Most are no record, and a look is cheaper than an atomic.
  if (cell < control.least[axis]) atomicMin(control.least[axis], cell);
  if (cell > control.greatest[axis]) atomicMax(control.greatest[axis], cell);
}

void main() {
  if (halt.isHalted != 0) return;
  uint i = gl_GlobalInvocationID.x;
  if (i >= parameters.count) return;
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
  if (control.untilSort > 0) {
    parcels[locatedAt(i).w].rate = rate;
    return;
  }
  brought[i] = rate;
  ivec3 cell = cellAt(place, 1.0 / parameters.cell);
  for (int axis = 0; axis < 3; ++axis) reach(axis, cell[axis]);
}
