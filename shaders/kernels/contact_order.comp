// The grid, 5 of 5: the order inside a bucket, by index, so that nothing depends on which thread came first; and
// positions and velocities beside them, in that order, for the query.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"

void main() {
  uint place = gl_GlobalInvocationID.x;
  if (place >= placedCount()) return;
  uint c = grid[gridEntry(place)];
  uint bucket = grid[gridBucketOf(c)];
  uint start = startOf(bucket);
  uint end = startOf(bucket + 1);
  uint before = 0;
  uint other = start;
  do {  // itself is there
    if (grid[gridEntry(other)] < c) ++before;
  } while (++other < end);
  if (other < end) control.isHalted = kHaltedByTurns;
  ContactRest rest = contactOf(c);
  places[start + before] = ContactPlace(uvec4(floatBitsToUint(positionOf(rest.particle)), groupOf(rest.strand)),
                                        uvec4(floatBitsToUint(velocityOf(rest.particle)), c));
}
