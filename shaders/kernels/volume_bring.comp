// Computes what each particle of the volume contributes to the nodes in the second and later iterations, from the
// velocities of the last iterate. Mirrored by reference/kernels/volume_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

void main() {
  uint seen = control.largest;
  uint i;
  if (!findParticle(i)) return;
  VolumeMotion motion = meanMotion(volumeParticle(i));
  parcels[locatedAt(i).w].rate =
      rateFrom(countedMassOf(i), motion.velocity, motion.place, displacementOf(i), seen);
}
