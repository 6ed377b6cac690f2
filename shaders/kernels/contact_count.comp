// The grid, 1 of 4: counts the contact particles in each bucket and gives each a rank in its bucket; the
// order of ranks is arbitrary. If some hair is a volume, contact particles without a possible partner nearby
// get empty lists and are put into no bucket.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"

// Whether one of the 27 cells around this one may hold a contact particle of another group. The eight nearest regions
// are tested in their place.
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
  readControl();
  uint c = gl_GlobalInvocationID.x;
  if (c >= numbers.contactCount) return;
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
