// If strands are divided among devices: marks the nodes of the grid that particles stepped here read, the corners of
// marked cells; one workgroup per block of nodes. Means at other nodes are not needed here. A few nodes are marked that
// nothing reads, where a row of cells begins. The reference has no counterpart: it has all strands.
#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

void main() {
  uint each = kBucketBlock / gl_WorkGroupSize.x;  // nodes per invocation
  uint first = gl_WorkGroupID.x * kBucketBlock + gl_LocalInvocationID.x * each;
  for (uint node = first; node < first + each; ++node) {
    bool asked = false;
    [[unroll]] for (uint corner = 0; corner < 8; ++corner) {
      uint before = cellIndex(cornerOf(uvec3(0), corner));
      asked = asked || cellNumber(cellMark(node - min(node, before))) == control.sorts;
    }
    cells[nodeAsked(node)] = asked ? 1 : 0;
  }
}
