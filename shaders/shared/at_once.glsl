// Loops over records of other particles load several before they use the first. An invocation spends most of
// its time waiting for memory, and several loads take no longer than one.
#ifndef RINGLET_AT_ONCE
#define RINGLET_AT_ONCE

const uint kAtOnce = 4;

/// Removes the lowest bits from a mask that is not 0, at most kAtOnce. Returns their number; unused entries
/// of `bits` repeat the last one.
uint takeBits(inout uint mask, out uint bits[kAtOnce]) {
  uint count = min(uint(bitCount(mask)), kAtOnce);
  for (uint j = 0; j < kAtOnce; ++j) {
    bits[j] = uint(findLSB(mask));
    if (j + 1 < count) mask &= mask - 1;
  }
  mask &= mask - 1;
  return count;
}

#endif
