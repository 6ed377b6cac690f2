// Computes the terms that the volume adds to each particle's velocity system in the next iteration of the solve, from
// the nodes around it; and the density at the particle, for the next step. Mirrored by reference/kernels/volume_step.h.
#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

void main() {
  uint i;
  if (!findParticle(i)) return;
  VolumeParticle self = volumeParticle(i);
  vec3 s = displacementOf(i);
  float mass = countedMassOf(i);
  float g = mass * gain();
  vec3 inCells = uintBitsToFloat(locatedAt(i).xyz);
  uvec3 cell = cellInBox(inCells);
  vec4 mean = vec4(0);
  [[unroll]] for (uint corner = 0; corner < 8; ++corner) {
    uvec3 node = cornerOf(cell, corner);
    mean += nodeWeight(inCells - vec3(node)) * nodeAt(cellIndex(node));
  }
  states[i].density = mean.w;

  vec3 given = mass * (mean.xyz - numbers.stiffness * numbers.seconds * s);
  vec3 momentum = inWorld(given) + g * carriedVelocity(positionOf(self.particle));
  addedByVolume[self.particle] = self.inverseMassUnit * vec4(momentum, g);
}
