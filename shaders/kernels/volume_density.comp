// Computes the density at each node of the grid, in a step that sorts particles into cells: until the next one, no
// particle moves on the grid. If strands are divided among devices, it computes the sums over the particles here.
// Mirrored by reference/kernels/volume_step.h.
#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_nodes.glsl"

void take(VolumeParcel parcel, uint place, vec3 apart, float weight) {
  int term = int(roundEven(weight * uintBitsToFloat(cellNumber(parcelMass(place)))));
  high.x += term >> 16;
  low.x += term & 0xffff;
}

void main() {
  readBox();
  uint node;
  if (!sumAround(node)) return;
  if (!kDivided) {
    nodes[node].w = densityFrom(fromSums(high, low).x);
    return;
  }
  sums[densitySum(node)] = high.x;
  sums[densitySum(node) + 1] = low.x;
}
