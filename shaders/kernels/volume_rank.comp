// Orders the nodes of the volume's grid by the number of parcels around them, 1 of 2: counts nodes by bin of that
// number, and the last workgroup computes where each bin begins. Invocations that run in lockstep then have sums of
// about the same length, and nodes without parcels none. Which node comes first within a bin is arbitrary; no result
// depends on it.
#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "shared/last_group.glsl"
#include "shared/volume_rows.glsl"

shared uint counts[kNodeBins];

void main() {
  readBox();
  uint node = gl_GlobalInvocationID.x;
  uint count = halt.isHalted == 0 && node < box.cellCount ? rowsAround(placeOfNode(node)).end.w : 0;
  if (count > 0) atomicAdd(cells[nodeBin(binOf(count))], 1);
  if (!isLastGroup()) return;
  uint bin = gl_LocalInvocationID.x;
  if (bin < kNodeBins) counts[bin] = atomicOr(cells[nodeBin(bin)], 0);
  barrier();
  if (bin >= kNodeBins) return;
  uint before = 0;
  for (uint other = 0; other < bin; ++other) before += counts[other];
  cells[nodeBin(bin)] = before;
  if (bin + 1 < kNodeBins) return;
  control.filled = before + counts[bin];
  control.indirectFilled[0] = groupsOf(kNodeLanes * (before + counts[bin]));
}
