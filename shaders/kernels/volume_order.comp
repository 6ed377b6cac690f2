// Orders the cells of the volume's grid by the number of parcels in them, 2 of 2: writes each cell that has some to a
// place of its bin; and lists the nodes around such cells, in arbitrary order.
#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "shared/last_group.glsl"
#include "shared/volume_buffers.glsl"

/// Whether one of the eight cells around a node has parcels. Two cells along x have consecutive parcels.
bool isReached(uvec3 node) {
  bool reached = false;
  [[unroll]] for (uint k = 0; k < 4; ++k) {
    uvec3 away = uvec3(0, k & 1, k >> 1);
    if (any(lessThan(node, away))) continue;
    uint last = cellIndex(node - away);
    reached = reached || startOf(last + 1) > startOf(last - min(node.x, 1));
  }
  return reached;
}

void orderCell(uint cell) {
  uint count = startOf(cell + 1) - startOf(cell);
  uint slot = kNoSlot;
  if (count > 0) {
    slot = atomicAdd(cells[cellBin(binOf(count))], 1);
    cells[filledCell(slot)] = cell;
  }
  cells[slotOf(cell)] = slot;
  if (isReached(placeOfCell(cell))) cells[reachedNode(atomicAdd(control.reached, 1))] = cell;
}

void main() {
  readBox();
  if (halt.isHalted == 0 && gl_GlobalInvocationID.x < box.cellCount) orderCell(gl_GlobalInvocationID.x);
  if (isLastGroup() && gl_LocalInvocationID.x == 0)
    control.indirectReached[0] = groupsOf(atomicOr(control.reached, 0));
}
