// Computes the terms that the volume adds to each particle's velocity system in the next iteration of the solve, from
// the nodes around it; and the density at the particle, for the next step. Mirrored by reference/kernels/volume_step.h.
#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

void main() {
  readBox();
  uint i;
  if (!findParticle(i)) return;
  VolumeParticle self = volumeParticle(i);
  vec3 s = displacementOf(i);
  float mass = countedMassOf(i);
  float g = mass * gain();
  uvec4 located = locatedAt(i);
  vec3 inCells = uintBitsToFloat(located.xyz);
  uvec3 cell = cellInBox(inCells);
  vec4 mean = vec4(0);
  mat3 gradient = mat3(0);
  [[unroll]] for (uint corner = 0; corner < 8; ++corner) {
    uvec3 node = cornerOf(cell, corner);
    vec3 apart = inCells - vec3(node);
    vec4 there = nodeAt(cellIndex(node));
    mean += nodeWeight(apart) * there;
    gradient += outerProduct(there.xyz, nodeGradient(apart, vec3(node - cell)));
  }
  gradient *= box.cellsPerMetre;
  states[i].density = mean.w;
  setParcel(located.w, inCells, keptGradient(gradient, inCells - vec3(cell), numbers.rim, numbers.gradient));

  vec3 given = inWorld(mass * (mean.xyz - numbers.stiffness * numbers.seconds * s));
  float share = self.inverseMassUnit / max(float(self.present), 1.0);
  for (uint j = 0; j < self.count; ++j) {
    bool gets = j >= self.pinned && j < self.present;
    vec3 momentum = given + g * carriedVelocity(positionOf(self.first + j));
    addedByVolume[self.first + j] = gets ? share * vec4(momentum, g) : vec4(0);
  }
}
