// Along each column of a light's box: converts the area in each cell to the area in front of its middle.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/shadow_volume.glsl"

void main() {
  uint columns = picture.shadowCells * picture.shadowCells;
  uint light = gl_GlobalInvocationID.x / columns;
  if (light >= 2) return;
  uint at = light * picture.shadowSlices * columns + gl_GlobalInvocationID.x - light * columns;
  uint sum = 0;
  uint slice = 0;
  do {
    uint here = shadows[at];
    shadows[at] = sum + here / 2;
    sum += here;
    at += columns;
  } while (++slice < picture.shadowSlices);
}
