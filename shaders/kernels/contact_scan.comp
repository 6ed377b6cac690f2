// The grid, 2 of 4: the start of each bucket within its block of buckets, and of each block.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"
#include "scan/bucket_starts.glsl"

uint entriesOf(uint bucket) { return grid[gridCount(bucket)]; }
void setStart(uint bucket, uint start) {
  grid[gridCount(bucket)] = 0;
  grid[gridStart(bucket)] = start;
}
uint sumOf(uint block) { return atomicOr(grid[gridSum(block)], 0); }
uint exchangeSum(uint block, uint sum) { return atomicExchange(grid[gridSum(block)], sum); }

void main() {
  uint all;
  if (!setStarts(all)) return;
  // The bucket after the last one starts after all entries.
  grid[gridSum(gl_NumWorkGroups.x)] = all;
  grid[gridStart(numbers.bucketCount)] = 0;
}
