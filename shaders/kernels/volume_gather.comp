// Computes at each node of the grid the mean of the contributions of particles in the eight cells around it, and the
// density. Neighbouring cells along x are consecutive, so the eight are four ranges. Mirrored by
// reference/kernels/volume_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

// a / b; exact for a < 2^21, and faster than an integer division.
uint quotient(uint a, uint b) { return uint((float(a) + 0.5) / float(b)); }

void main() {
  uint node = gl_GlobalInvocationID.x;
  if (halt.isHalted != 0 || node >= control.cellCount) return;
  if (kDivided && cellNumber(nodeAsked(node)) == 0) return;
  uvec3 size = boxSize();
  uint row = quotient(node, size.x);
  uint z = quotient(row, size.y);
  uvec3 at = uvec3(node - row * size.x, row - z * size.y, z);
  vec4 sum = vec4(0);
  float mass = 0.0;
  uint wanted = 4;  // turns that the loops should make; `made` counts those they made
  uint made = 0;
  uint turn = 0;
  do {
    uint y = at.y - (turn & 1);
    uint z = at.z - (turn >> 1);
    bool isIn = y < size.y && z < size.z;  // coordinates below 0 wrap to large numbers
    uint last = isIn ? (z * size.y + y) * size.x + at.x : 0;
    uint place = isIn ? startOf(last - min(at.x, 1)) : 0;
    uint end = isIn ? startOf(last + 1) : 0;
    wanted += end - place;
    if (place < end) do {
      VolumeParcel parcel = parcelAt(place);
      float weight = nodeWeight(parcel.place.xyz - vec3(at));
      sum += weight * parcel.rate;
      mass += weight * parcel.place.w;
      ++made;
    } while (++place < end);
    ++made;
  } while (++turn < 4);
  if (made != wanted) halt.isHalted = kHaltedByTurns;
  nodes[node] = vec4(sum.w > 0.0 ? sum.xyz / sum.w : vec3(0),
                     mass * control.cellsPerMetre * control.cellsPerMetre * control.cellsPerMetre);
}
