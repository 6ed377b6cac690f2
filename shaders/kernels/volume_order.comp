// Orders the nodes of the volume's grid by the number of parcels around them, 2 of 2: writes each node that has some
// to a place of its bin.
#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_rows.glsl"

void main() {
  readBox();
  uint node = gl_GlobalInvocationID.x;
  if (halt.isHalted != 0 || node >= box.cellCount) return;
  uint count = rowsAround(placeOfNode(node)).end.w;
  if (count > 0) cells[nodeOrder(atomicAdd(cells[nodeBin(binOf(count))], 1))] = node;
}
