// Sums over a workgroup through shared memory; for any device, also without subgroup operations.
#ifndef RINGLET_BLOCK_SUM
#define RINGLET_BLOCK_SUM

#include "shared/workgroup.glsl"

shared uint blockSums[kMostInvocations];

/// The sum of x over the invocations before this one. Call it with all invocations of the workgroup.
uint sumBefore(uint x) {
  uint i = gl_LocalInvocationID.x;
  blockSums[i] = x;
  barrier();
  for (uint offset = 1; offset < gl_WorkGroupSize.x; offset *= 2) {
    uint other = i >= offset ? blockSums[i - offset] : 0;
    barrier();
    blockSums[i] += other;
    barrier();
  }
  return blockSums[i] - x;
}

#endif
