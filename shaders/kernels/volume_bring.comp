// What each particle of the volume brings to the nodes in a later iteration, from the velocities of the last. Mirrored
// by reference/kernels/volume_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

void main() {
  if (halt.isHalted != 0) return;
  uint i = gl_GlobalInvocationID.x;
  if (i >= parameters.count) return;
  uint particle = volumeParticle(i).particle;
  parcels[locatedAt(i).w].rate = rateFrom(placeOf(i).w, velocityOf(particle), positionOf(particle), memoryOf(i).xyz);
}
