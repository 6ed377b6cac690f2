// Computes at each node of the grid the mean of the contributions of particles in the eight cells around it; if strands
// are divided among devices, its sums over the particles here. Mirrored by reference/kernels/volume_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_nodes.glsl"

void take(VolumeParcel parcel, float weight) {
  ivec4 term = ivec4(roundEven(weight * parcel.rate));
  high += term >> 16;
  low += term & 0xffff;
}

void main() {
  uint node;
  if (!sumAround(node)) return;
  if (!kDivided) {
    nodes[node].xyz = meanRate(fromSums(high, low));
    return;
  }
  for (uint k = 0; k < 4; ++k) {
    sums[nodeSum(node) + k] = high[k];
    sums[nodeSum(node) + 4 + k] = low[k];
  }
}
