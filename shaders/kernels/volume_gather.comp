// The grid's nodes: the mean of what particles of the eight cells about a node bring, and the density there. Cells
// along x follow each other, so that they are four ranges. Mirrored by reference/kernels/volume_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

void main() {
  uint node = gl_GlobalInvocationID.x;
  if (halt.isHalted != 0 || node >= control.cellCount) return;
  uvec3 size = boxSize();
  uvec3 at = uvec3(node % size.x, node / size.x % size.y, node / (size.x * size.y));
  vec4 sum = vec4(0);
  float mass = 0.0;
  uint wanted = 4;  // turns of the loops; and how many they made
  uint made = 0;
  uint row = 0;
  do {
    uint y = at.y - (row & 1);
    uint z = at.z - (row >> 1);
    bool isIn = y < size.y && z < size.z;  // below 0 they are large
    uint last = isIn ? (z * size.y + y) * size.x + at.x : 0;
    uint place = isIn ? startOf(last - min(at.x, 1)) : 0;
    uint end = isIn ? startOf(last + 1) : 0;
    wanted += end - place;
    if (place < end) do {
      VolumeParcel parcel = parcelAt(place);
      float weight = nodeWeight(parcel.place.xyz - vec3(at));
      sum += weight * parcel.rate;
      mass += weight * parcel.place.w;
      ++made;
    } while (++place < end);
    ++made;
  } while (++row < 4);
  if (made != wanted) halt.isHalted = kHaltedByTurns;
  nodes[node] = vec4(sum.w > 0.0 ? sum.xyz / sum.w : vec3(0),
                     mass * control.cellsPerMetre * control.cellsPerMetre * control.cellsPerMetre);
}
