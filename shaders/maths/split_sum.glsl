// Sums of many integers, of which 32 bits have no room: of each term its upper 16 bits are added to `high`, the lower
// to `low`, and the sum is 65536 high + low. Up to 65537 terms may be added between two carries: low is unsigned then.
#ifndef RINGLET_SPLIT_SUM
#define RINGLET_SPLIT_SUM

/// What the low numbers hold beyond 16 bits goes into the high ones.
void carry(inout ivec4 high, inout ivec4 low) {
  high += ivec4(uvec4(low) >> 16);
  low &= 0xffff;
}

vec4 fromSums(ivec4 high, ivec4 low) {
  carry(high, low);
  return vec4(high) * 65536.0 + vec4(low);
}

#endif
