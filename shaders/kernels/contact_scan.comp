// The grid, 2 of 5: the start of each bucket within its block of buckets, and the sum of the block; one workgroup per
// block. Resets the counts to zero for the next rebuild.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"
#include "scan/block_sum.glsl"

void main() {
  uint each = kBucketBlock / gl_WorkGroupSize.x;  // buckets per invocation
  uint first = gl_WorkGroupID.x * kBucketBlock + gl_LocalInvocationID.x * each;
  uint sum = 0;
  for (uint k = 0; k < each; ++k) sum += grid[gridCount(first + k)];
  uint before = sumBefore(sum);
  for (uint k = 0; k < each; ++k) {
    uint count = grid[gridCount(first + k)];
    grid[gridCount(first + k)] = 0;
    grid[gridStart(first + k)] = before;
    before += count;
  }
  if (gl_LocalInvocationID.x + 1 == gl_WorkGroupSize.x) grid[gridSum(gl_WorkGroupID.x)] = before;
}
