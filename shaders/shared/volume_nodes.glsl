// Sums over the parcels around a node of the volume's grid (shared/volume_rows.glsl). kNodeLanes invocations share a
// node, each with every so many-th parcel, and the first adds up the results: on a GPU a dispatch takes as long as the
// longest sum, of a crowded cell. Terms are integers, so that no sum depends on their order, and split
// (maths/split_sum.glsl). The kernel that includes this defines what is summed (take).
#ifndef RINGLET_VOLUME_NODES
#define RINGLET_VOLUME_NODES

#include "maths/split_sum.glsl"
#include "shared/at_once.glsl"
#include "shared/volume_rows.glsl"
#include "shared/workgroup.glsl"

// The sum so far.
ivec4 high = ivec4(0);
ivec4 low = ivec4(0);

/// place: of the parcel among all; apart: from the node [cells].
void take(VolumeParcel parcel, uint place, vec3 apart, float weight);

/// Parcels that an invocation loads before it uses the first.
const uint kTogether = kForGpu ? kAtOnce : 1;

void sumParcels(uint node, uint lane) {
  uvec3 at = placeOfNode(node);
  Rows rows = rowsAround(at);
  uint all = rows.end.w;
  uint turn = 0;
  uint t = lane;
  for (; t < all; t += kTogether * kNodeLanes) {
    uint places[kAtOnce];
    VolumeParcel some[kAtOnce];
    for (uint j = 0; j < kTogether; ++j) places[j] = placeIn(rows, min(t + j * kNodeLanes, all - 1));
    for (uint j = 0; j < kTogether; ++j) some[j] = parcelAt(places[j]);
    for (uint j = 0; j < kTogether; ++j) {
      vec3 apart = some[j].place.xyz - vec3(at);
      take(some[j], places[j], apart, t + j * kNodeLanes < all ? nodeWeight(apart) : 0.0);
    }
    if ((++turn & 0x3fff) == 0) carry(high, low);
  }
  carry(high, low);
  if (t < all) halt.isHalted = kHaltedByTurns;  // the driver ended the loop early
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
/// with all invocations, after readBox. If strands are divided among devices, nodes have no order: one without parcels
/// here has sums too.
bool sumAround(out uint node) {
  uint nodes = gl_WorkGroupSize.x / kNodeLanes;
  uint lane = gl_LocalInvocationID.x / nodes;
  node = gl_WorkGroupID.x * nodes + gl_LocalInvocationID.x % nodes;
  bool isNode = halt.isHalted == 0 && node < (kDivided ? box.cellCount : box.filled);
  if (isNode && !kDivided) node = cellNumber(nodeOrder(node));
  if (isNode) sumParcels(node, lane);
  if (kNodeLanes > 1) addLanes(lane, nodes);
  return isNode && lane == 0;
}

#endif
