// Sums of many integers that exceed 32 bits: the upper 16 bits of each term are added to `high`, the lower
// ones to `low`, and the sum is 65536 high + low. Up to 65537 terms may be added between two carries, since
// low counts as unsigned.
#ifndef RINGLET_SPLIT_SUM
#define RINGLET_SPLIT_SUM

/// Moves the bits of the low numbers beyond 16 into the high ones.
void carry(inout ivec4 high, inout ivec4 low) {
  high += ivec4(uvec4(low) >> 16);
  low &= 0xffff;
}

vec4 fromSums(ivec4 high, ivec4 low) {
  carry(high, low);
  return vec4(high) * 65536.0 + vec4(low);
}

#endif
