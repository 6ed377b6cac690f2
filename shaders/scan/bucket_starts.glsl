// Where buckets of sorted entries start, from how many each has: prefix sums over a dispatch with a workgroup per block
// of kBucketBlock buckets. The kernel that includes this says where numbers stand: RINGLET_COUNT(bucket),
// RINGLET_START(bucket), RINGLET_SUM(block); and it has what shared/last_group.glsl asks for.
#ifndef RINGLET_BUCKET_STARTS
#define RINGLET_BUCKET_STARTS

#include "scan/block_sum.glsl"
#include "shared/last_group.glsl"

// The start of each bucket within the block of this workgroup; sets counts to 0 for the next time. The block's sum is
// exchanged and not assigned, so that the last workgroup sees it.
void startInBlock() {
  uint each = kBucketBlock / gl_WorkGroupSize.x;  // buckets per invocation
  uint first = gl_WorkGroupID.x * kBucketBlock + gl_LocalInvocationID.x * each;
  uint sum = 0;
  for (uint k = 0; k < each; ++k) sum += RINGLET_COUNT(first + k);
  uint before = sumBefore(sum);
  for (uint k = 0; k < each; ++k) {
    uint count = RINGLET_COUNT(first + k);
    RINGLET_COUNT(first + k) = 0;
    RINGLET_START(first + k) = before;
    before += count;
  }
  if (gl_LocalInvocationID.x + 1 == gl_WorkGroupSize.x) atomicExchange(RINGLET_SUM(gl_WorkGroupID.x), before);
}

/// Sets all starts within blocks, and the sum before each block. Called once, by all invocations. True in one of them,
/// with the number of all entries.
bool setStarts(out uint all) {
  startInBlock();
  if (!isLastGroup()) return false;
  uint each = (gl_NumWorkGroups.x + gl_WorkGroupSize.x - 1) / gl_WorkGroupSize.x;  // blocks per invocation
  uint first = min(gl_LocalInvocationID.x * each, gl_NumWorkGroups.x);
  uint end = min(first + each, gl_NumWorkGroups.x);
  uint sum = 0;
  for (uint block = first; block < end; ++block) sum += atomicOr(RINGLET_SUM(block), 0);
  uint before = sumBefore(sum);
  for (uint block = first; block < end; ++block) before += atomicExchange(RINGLET_SUM(block), before);
  all = before;
  return gl_LocalInvocationID.x + 1 == gl_WorkGroupSize.x;
}

#endif
