// The grid, 4 of 4: sorts the contact particles of each bucket by index, so that results do not depend on the order of
// threads, and stores positions and velocities in that order for the query.
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
  do {  // at least one turn: the particle itself is in its bucket
    if (grid[gridEntry(other)] < c) ++before;
  } while (++other < end);
  if (other < end) control.isHalted = kHaltedByTurns;
  ContactRest rest = contactOf(c);
  places[start + before] = ContactPlace(uvec4(floatBitsToUint(positionOf(rest.particle)), groupOf(rest.strand)),
                                        uvec4(floatBitsToUint(velocityOf(rest.particle)), c));
}
