// The grid, 1 of 5: how many contact particles are in each bucket, and each one's rank there, in any order. Beside a
// volume those that have nobody to meet near them have empty lists and are in no bucket.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"

// Whether anybody of another group may be in one of the cells about this one: in the eight regions nearest to it.
bool hasOthersNear(ivec3 cell, uint group) {
  ivec3 nearer = (cell & 1) * 2 - 1;
  bool others = false;
  for (int k = 0; k < 8; ++k) {
    ivec3 region = (cell >> 1) + nearer * ivec3(k & 1, k >> 1 & 1, k >> 2);
    others = others || hasOthers(grid[regionGroups(bucketOf(region))], group);
  }
  return others;
}

void main() {
  uint c = gl_GlobalInvocationID.x;
  if (c >= parameters.contactCount) return;
  ContactRest rest = contactOf(c);
  vec3 x = positionOf(rest.particle);
  ivec3 cell = cellOf(x);
  if (kInGroups && !hasOthersNear(cell, groupOf(rest.strand))) {
    grid[gridBucketOf(c)] = kNoBucket;
    lists[listOf(c)] = 0;
    setListed(c, x, velocityOf(rest.particle));
    return;
  }
  uint bucket = bucketOf(cell);
  grid[gridBucketOf(c)] = bucket;
  grid[gridRank(c)] = atomicAdd(grid[gridCount(bucket)], 1);
}
