// Probe of `ringlet conform`: small integers, which are denormal as floats, moved as components of a vec4 and
// of a uvec4. Records with an odd index come out in reverse order.
#version 450

layout(local_size_x_id = 0) in;
layout(std430, set = 0, binding = 0) readonly buffer Integers { uvec4 integers[]; };
layout(std430, set = 0, binding = 1) writeonly buffer MovedIntegers { uvec4 movedIntegers[]; };
layout(std430, set = 0, binding = 2) readonly buffer Floats { vec4 floats[]; };
layout(std430, set = 0, binding = 3) writeonly buffer MovedFloats { vec4 movedFloats[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  bool isOdd = (i & 1) != 0;
  uvec4 integer = integers[i];
  movedIntegers[i] = isOdd ? integer.wzyx : integer;
  vec4 number = floats[i];
  movedFloats[i] = isOdd ? number.wzyx : number;
}
