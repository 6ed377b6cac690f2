// The grid, 3 of 5: the start of each block of buckets; one workgroup.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"
#include "scan/block_sum.glsl"

void main() {
  uint blockCount = parameters.bucketCount / kBucketBlock;
  uint each = (blockCount + gl_WorkGroupSize.x - 1) / gl_WorkGroupSize.x;
  uint first = min(gl_LocalInvocationID.x * each, blockCount);
  uint end = min(first + each, blockCount);
  uint sum = 0;
  for (uint block = first; block < end; ++block) sum += grid[gridSum(block)];
  uint before = sumBefore(sum);
  for (uint block = first; block < end; ++block) {
    uint count = grid[gridSum(block)];
    grid[gridSum(block)] = before;
    before += count;
  }
  // The start of the bucket beyond the last is the number of all.
  if (gl_LocalInvocationID.x + 1 == gl_WorkGroupSize.x) {
    grid[gridSum(blockCount)] = before;
    grid[gridStart(parameters.bucketCount)] = 0;
  }
}
