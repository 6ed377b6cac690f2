// Sums over the parcels in the eight cells around a node of the volume's grid. Neighbouring cells along x are
// consecutive, so the eight are four ranges; kNodeLanes invocations share a node, each with the same number
// of ranges, and the first adds up the results: on a GPU a dispatch takes as long as the longest range, of a
// crowded cell. Terms are integers, so that no sum depends on their order, and split (maths/split_sum.glsl).
// The kernel that includes this defines what is summed (take).
#ifndef RINGLET_VOLUME_NODES
#define RINGLET_VOLUME_NODES

#include "maths/split_sum.glsl"
#include "shared/at_once.glsl"
#include "shared/volume_buffers.glsl"
#include "shared/workgroup.glsl"

// The sum so far.
ivec4 high = ivec4(0);
ivec4 low = ivec4(0);

void take(VolumeParcel parcel, float weight);

// a / b; exact for a < 2^21, and faster than an integer division.
uint quotient(uint a, uint b) { return uint((float(a) + 0.5) / float(b)); }

void sumRanges(uint node, uint first, uint end) {
  uvec3 size = boxSize();
  uint row = quotient(node, size.x);
  uint z = quotient(row, size.y);
  uvec3 at = uvec3(node - row * size.x, row - z * size.y, z);
  uint wanted = end - first;  // turns that the loops should make; `made` counts those they made
  uint made = 0;
  uint turn = first;
  do {
    uint y = at.y - (turn & 1);
    uint z = at.z - (turn >> 1);
    bool isIn = y < size.y && z < size.z;  // coordinates below 0 wrap to large numbers
    uint last = isIn ? (z * size.y + y) * size.x + at.x : 0;
    uint place = isIn ? startOf(last - min(at.x, 1)) : 0;
    uint end = isIn ? startOf(last + 1) : 0;
    wanted += (end - place + kAtOnce - 1) / kAtOnce;
    if (place < end) do {
      VolumeParcel some[kAtOnce];
      for (uint j = 0; j < kAtOnce; ++j) some[j] = parcelAt(min(place + j, end - 1));
      for (uint j = 0; j < kAtOnce; ++j)
        take(some[j], place + j < end ? nodeWeight(some[j].place - vec3(at)) : 0.0);
      ++made;
      place += kAtOnce;
    } while (place < end);
    carry(high, low);
    ++made;
  } while (++turn < end);
  if (made != wanted) halt.isHalted = kHaltedByTurns;
}

shared ivec4 sharedHigh[kNodeLanes > 1 ? kMostInvocations : 1];
shared ivec4 sharedLow[kNodeLanes > 1 ? kMostInvocations : 1];

// Call it with all invocations of the workgroup. The lanes of a node are as far apart as the group has nodes.
void addLanes(uint lane, uint nodes) {
  uint at = gl_LocalInvocationID.x;
  sharedHigh[at] = high;
  sharedLow[at] = low;
  barrier();
  if (lane > 0) return;
  for (uint other = 1; other < kNodeLanes; ++other) {
    high += sharedHigh[at + other * nodes];
    low += sharedLow[at + other * nodes];
  }
  carry(high, low);
}

/// Sets `high` and `low` to the sums of this invocation's node; false if it has none to write. Call it once,
/// with all invocations.
bool sumAround(out uint node) {
  uint nodes = gl_WorkGroupSize.x / kNodeLanes;
  uint lane = gl_LocalInvocationID.x / nodes;
  node = gl_WorkGroupID.x * nodes + gl_LocalInvocationID.x % nodes;
  bool isNode = halt.isHalted == 0 && node < control.cellCount;
  uint each = 4 / kNodeLanes;
  if (isNode) sumRanges(node, lane * each, (lane + 1) * each);
  if (kNodeLanes > 1) addLanes(lane, nodes);
  return isNode && lane == 0;
}

#endif
