// The grid, 2 of 5: where each bucket starts within its block of buckets, a workgroup a block, and the block's sum.
// Leaves the counts zero for the next time.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"
#include "scan/block_sum.glsl"

void main() {
  uint each = kBucketBlock / gl_WorkGroupSize.x;  // buckets of an invocation
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
