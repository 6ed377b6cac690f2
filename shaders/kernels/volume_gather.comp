// Computes at each node of the grid the mean of the contributions of particles in the eight cells around it; if strands
// are divided among devices, its sums over the particles here. Mirrored by reference/kernels/volume_step.h.
#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_nodes.glsl"

float cellInRate = 0;  // cell size as a share of mostRate, so that C has the unit of a parcel's rate [s]

void take(VolumeParcel parcel, uint place, vec3 apart, float weight) {
  vec3 there = gradientOf(parcel) * (-cellInRate * apart);
  vec4 rate = parcel.rate;
  rate.xyz = clamp(rate.xyz + rate.w * there, -rate.www, rate.www);
  ivec4 term = ivec4(roundEven(weight * rate));
  high += term >> 16;
  low += term & 0xffff;
}

void main() {
  readBox();
  cellInRate = box.cell / numbers.mostRate;
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
