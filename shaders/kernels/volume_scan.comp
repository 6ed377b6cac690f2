// Sorts particles of the volume by cell, 2 of 5: the start of each cell within its block of cells, and the sum of the
// block; one workgroup per block. Resets the counts to zero for the next sort.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"
#include "scan/block_sum.glsl"

void main() {
  uint each = kBucketBlock / gl_WorkGroupSize.x;  // cells per invocation
  uint first = gl_WorkGroupID.x * kBucketBlock + gl_LocalInvocationID.x * each;
  uint sum = 0;
  for (uint k = 0; k < each; ++k) sum += cells[cellCount(first + k)];
  uint before = sumBefore(sum);
  for (uint k = 0; k < each; ++k) {
    uint count = cells[cellCount(first + k)];
    cells[cellCount(first + k)] = 0;
    cells[cellStart(first + k)] = before;
    before += count;
  }
  if (gl_LocalInvocationID.x + 1 == gl_WorkGroupSize.x) cells[cellSum(gl_WorkGroupID.x)] = before;
}
