// The grid, 2 of 4: the start of each bucket within its block of buckets, and of each block.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"
#define RINGLET_COUNT(bucket) grid[gridCount(bucket)]
#define RINGLET_START(bucket) grid[gridStart(bucket)]
#define RINGLET_SUM(block) grid[gridSum(block)]
#include "scan/bucket_starts.glsl"

void main() {
  uint all;
  if (!setStarts(all)) return;
  // The bucket beyond the last starts after all.
  grid[gridSum(gl_NumWorkGroups.x)] = all;
  grid[gridStart(parameters.bucketCount)] = 0;
}
