// Particles of the volume by cell, 4 of 6: where each cell starts.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

void main() {
  uint cell = gl_GlobalInvocationID.x;
  if (cell > control.cellCount) return;
  cells[cellStart(cell)] += cells[cellSum(cell / kBucketBlock)];
}
