// The grid, 3 of 4: puts contact particles into their buckets; the order within a bucket is arbitrary.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"

void main() {
  uint c = gl_GlobalInvocationID.x;
  if (c >= numbers.contactCount) return;
  uint bucket = grid[gridBucketOf(c)];
  if (bucket != kNoBucket) grid[gridEntry(startOf(bucket) + grid[gridRank(c)])] = c;
}
