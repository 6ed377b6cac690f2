// Loops over records of other particles ask for several before they use the first. An invocation spends most of its
// time waiting for memory, and waits for all of these as long as for one.
#ifndef RINGLET_AT_ONCE
#define RINGLET_AT_ONCE

const uint kAtOnce = 4;

/// Takes the lowest bits out of a mask that is not 0. Returns how many; behind these `bits` repeats the last.
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
