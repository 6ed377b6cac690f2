// Sorts particles of the volume by cell, 3 of 4: the start of each cell; one workgroup per block of cells.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

void main() {
  uint each = kBucketBlock / gl_WorkGroupSize.x;  // cells per invocation
  uint first = gl_WorkGroupID.x * kBucketBlock + gl_LocalInvocationID.x * each;
  uint before = cells[cellSum(gl_WorkGroupID.x)];
  for (uint k = 0; k < each; ++k) cells[cellStart(first + k)] += before;
}
