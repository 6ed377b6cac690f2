// Computes the density at each node of the grid, in a step that sorts particles into cells: until the next one, no
// particle moves on the grid. If strands are divided among devices, it computes the sums over the particles here.
// Mirrored by reference/kernels/volume_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_nodes.glsl"

int high = 0;
int low = 0;

void take(VolumeParcel parcel, float weight) {
  int term = int(roundEven(weight * parcel.place.w));
  high += term >> 16;
  low += term & 0xffff;
}
void carry() {
  high += int(uint(low) >> 16);
  low &= 0xffff;
}

void main() {
  uint node;
  if (!findNode(node)) return;
  sumAround(node);
  if (!kDivided) {
    nodes[node].w = densityFrom(fromSums(ivec4(high), ivec4(low)).x);
    return;
  }
  sums[densitySum(node)] = high;
  sums[densitySum(node) + 1] = low;
}
