// The grid, 1 of 5: how many contact particles are in each bucket, and each one's rank there, in any order.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"

void main() {
  uint c = gl_GlobalInvocationID.x;
  if (c >= parameters.contactCount) return;
  uint bucket = bucketOf(cellOf(positionOf(contactOf(c).particle)));
  grid[gridBucketOf(c)] = bucket;
  grid[gridRank(c)] = atomicAdd(grid[gridCount(bucket)], 1);
}
