// Where strands are divided among devices: the grid's nodes that particles stepped here ask, which are the corners of
// marked cells; a workgroup a block of nodes. The means at others nobody here needs; a few that nobody asks are among
// these, where a row of cells begins. Mirrored by nothing: the reference has all strands.
#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

void main() {
  uint each = kBucketBlock / gl_WorkGroupSize.x;  // nodes of an invocation
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
