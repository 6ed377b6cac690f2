// Computes where each bucket of sorted entries starts, from its number of entries: prefix sums by a dispatch
// with a workgroup for each block of kBucketBlock buckets. The kernel that includes this defines where the
// numbers are stored, and what shared/last_group.glsl requires.
#ifndef RINGLET_BUCKET_STARTS
#define RINGLET_BUCKET_STARTS

#include "layout/contacts.h"
#include "scan/block_sum.glsl"
#include "shared/last_group.glsl"
#include "shared/workgroup.glsl"

/// Number of entries of a bucket.
uint entriesOf(uint bucket);
/// Sets the start of a bucket within its block, and its number of entries to 0 for the next time.
void setStart(uint bucket, uint start);
/// The sum of a block: reads it, and replaces it by `sum` and returns the old value. By atomics, which the
/// last workgroup sees.
uint sumOf(uint block);
uint exchangeSum(uint block, uint sum);

// The start of each bucket within the block of this workgroup, and the block's sum.
void startInBlock() {
  uint each = kBucketBlock / gl_WorkGroupSize.x;  // buckets per invocation
  uint first = gl_WorkGroupID.x * kBucketBlock + gl_LocalInvocationID.x * each;
  uint sum = 0;
  for (uint k = 0; k < each; ++k) sum += entriesOf(first + k);
  uint before = sumBefore(sum);
  for (uint k = 0; k < each; ++k) {
    uint entries = entriesOf(first + k);
    setStart(first + k, before);
    before += entries;
  }
  if (gl_LocalInvocationID.x + 1 == gl_WorkGroupSize.x) exchangeSum(gl_WorkGroupID.x, before);
}

/// Sets all starts within blocks, and the sum before each block. Call it once, with all invocations. Returns
/// true in one of them, with the number of all entries.
bool setStarts(out uint all) {
  startInBlock();
  if (!isLastGroup()) return false;
  uint each = (gl_NumWorkGroups.x + gl_WorkGroupSize.x - 1) / gl_WorkGroupSize.x;  // blocks per invocation
  uint first = min(gl_LocalInvocationID.x * each, gl_NumWorkGroups.x);
  uint end = min(first + each, gl_NumWorkGroups.x);
  uint sum = 0;
  for (uint block = first; block < end; ++block) sum += sumOf(block);
  uint before = sumBefore(sum);
  for (uint block = first; block < end; ++block) before += exchangeSum(block, before);
  all = before;
  return gl_LocalInvocationID.x + 1 == gl_WorkGroupSize.x;
}

#endif
