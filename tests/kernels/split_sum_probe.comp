// maths/split_sum.glsl by itself: of each pair of high and low numbers the pair after a carry, and its sum.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "maths/split_sum.glsl"

layout(local_size_x_id = 0) in;
layout(set = 0, binding = 0) readonly buffer Pairs { ivec4 pairs[]; };    // high, low
layout(set = 0, binding = 1) buffer Carried { ivec4 carried[]; };         // high, low, the sum's bits
layout(push_constant) uniform Parameters { uint count; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  ivec4 high = pairs[2 * i], low = pairs[2 * i + 1];
  carried[3 * i + 2] = floatBitsToInt(fromSums(high, low));
  carry(high, low);
  carried[3 * i] = high;
  carried[3 * i + 1] = low;
}
