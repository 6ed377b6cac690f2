// Sums over the parcels in the eight cells around a node of the volume's grid. Neighbouring cells along x are
// consecutive, so the eight are four ranges. The kernel that includes this defines what is summed (take), and moves
// what its low numbers hold beyond 16 bits into the high ones (carry). Terms are integers, so that no sum depends on
// their order; a number is split because 31 bits have no room for the sum of many.
#ifndef RINGLET_VOLUME_NODES
#define RINGLET_VOLUME_NODES

#include "shared/volume_buffers.glsl"

void take(VolumeParcel parcel, float weight);
void carry();

// a / b; exact for a < 2^21, and faster than an integer division.
uint quotient(uint a, uint b) { return uint((float(a) + 0.5) / float(b)); }

void sumAround(uint node) {
  uvec3 size = boxSize();
  uint row = quotient(node, size.x);
  uint z = quotient(row, size.y);
  uvec3 at = uvec3(node - row * size.x, row - z * size.y, z);
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
      take(parcel, nodeWeight(parcel.place.xyz - vec3(at)));
      ++made;
    } while (++place < end);
    carry();
    ++made;
  } while (++turn < 4);
  if (made != wanted) halt.isHalted = kHaltedByTurns;
}

/// Finds the node of this invocation; false if there is none.
bool findNode(out uint node) {
  node = gl_GlobalInvocationID.x;
  return halt.isHalted == 0 && node < control.cellCount;
}

#endif
