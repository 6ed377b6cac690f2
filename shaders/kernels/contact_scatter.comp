// The grid, 4 of 5: contact particles by bucket, in any order inside one.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"

void main() {
  uint c = gl_GlobalInvocationID.x;
  if (c >= parameters.contactCount) return;
  uint bucket = grid[gridBucketOf(c)];
  if (bucket != kNoBucket) grid[gridEntry(startOf(bucket) + grid[gridRank(c)])] = c;
}
