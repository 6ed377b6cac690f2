// Begins a step of the volume. Advances the displacement of each particle: it decays, and grows by the
// particle's motion in the head's frame. Computes the particle's contribution to the nodes in the first
// iteration, from a guessed velocity; and the box of cells that contains all particles. Mirrored by
// reference/kernels/volume_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

void main() {
  uint seen = control.largest;
  float cell = control.cell;
  Reach reached = readReach();
  uint i;
  if (!findParticle(i)) return;
  VolumeParticle self = volumeParticle(i);
  VolumeState before = volumeState(i);
  bool isKnown = before.isKnown > 0.0;
  VolumeMotion motion = meanMotion(self);
  vec3 v = motion.velocity, x = motion.place;
  vec3 place = inHeadFrame(x);
  vec3 s = isKnown ? fadedDisplacement(before.displacement, place - before.place, numbers.kept) : vec3(0);
  precise vec3 last = vec3(0), given = vec3(0);  // given: J, to those that do not follow the head
  for (uint j = 0; j < self.present; ++j) {
    vec3 each = lastVelocityOf(self.first + j);
    vec4 added = addedTo(self.first + j);
    last += each;
    given += added.xyz - added.w * each;
  }
  last /= max(float(self.present), 1.0);
  given = self.mass > 0.0 ? given / (self.inverseMassUnit * self.mass) : vec3(0);
  vec3 change = isKnown ? guessedChange(numbers.warmth, gain(), last - before.predicted, given) : vec3(0);
  // A strand is a line: cells n times as large hold n times its mass in n^3 times the volume.
  float coarser = cell > numbers.cell ? numbers.cell / cell : 1.0;
  float mass = self.mass * othersShare(coarser * coarser * self.ownDensity, before.density);
  vec4 rate = rateFrom(mass, v + change, x, s, seen);
  states[i] = VolumeState(s, before.density, place, mass, v, 1);
  if (parameters.sorts != 0) {
    mat3 gradient = isKnown ? gradientOf(parcelAt(locatedAt(i).w)) : mat3(0);
    brought[i] = VolumeBrought(rate, vec4(gradient[0], 0), vec4(gradient[1], 0), vec4(gradient[2], 0));
    if (self.mass > 0.0) reachTo(place, reached);  // fallen hair has no mass: it is not part of the volume any more
  } else {
    parcels[locatedAt(i).w].rate = rate;
  }
}
