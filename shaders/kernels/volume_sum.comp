// Sorts particles of the volume by cell, 3 of 5: the start of each block of cells; one workgroup.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"
#include "scan/block_sum.glsl"

void main() {
  uint blockCount = control.indirectBlocks[0];
  uint each = (blockCount + gl_WorkGroupSize.x - 1) / gl_WorkGroupSize.x;
  uint first = min(gl_LocalInvocationID.x * each, blockCount);
  uint end = min(first + each, blockCount);
  uint sum = 0;
  for (uint block = first; block < end; ++block) sum += cells[cellSum(block)];
  uint before = sumBefore(sum);
  for (uint block = first; block < end; ++block) {
    uint count = cells[cellSum(block)];
    cells[cellSum(block)] = before;
    before += count;
  }
}
