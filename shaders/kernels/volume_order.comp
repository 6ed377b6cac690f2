// Sorts particles of the volume by cell, 6 of 6: gives each particle the place of its parcel, by index within a cell,
// so that no sum depends on the order of threads; and writes the parcel.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

void main() {
  if (halt.isHalted != 0) return;
  uint i = gl_GlobalInvocationID.x;
  if (i >= parameters.count) return;
  uint cell = cellNumber(cellOf(i));
  uint start = startOf(cell);
  uint first = cellEntry(start);
  uint end = cellEntry(startOf(cell + 1));
  uint before = 0;
  uint k = first / 4;
  do {  // at least one turn: the particle itself is in its cell
    uvec4 others = cellNumbers(k);
    for (uint j = 0; j < 4; ++j) {
      uint at = 4 * k + j;
      if (at >= first && at < end && others[j] < i) ++before;
    }
  } while (4 * ++k < end);
  if (4 * k < end) halt.isHalted = kHaltedByTurns;
  vec3 inCells = placeInCells(placeBroughtBy(i));
  parcels[start + before] = VolumeParcel(broughtBy(i), vec4(inCells, volumeParticle(i).mass));
  located[i] = uvec4(floatBitsToUint(inCells), start + before);
}
