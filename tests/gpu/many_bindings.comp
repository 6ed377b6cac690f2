// The kernel of spirv_bindings_test.cpp: buffers of every kind, reached in every way, and some that are not.
#version 450

layout(local_size_x = 1) in;
layout(constant_id = 0) const bool kOn = false;

layout(set = 0, binding = 1) readonly buffer Stored { uint stored[]; };
layout(set = 0, binding = 3) uniform Shift { uvec4 shift; };
layout(set = 0, binding = 4) uniform usamplerBuffer fetched;
layout(set = 0, binding = 5) uniform usamplerBuffer handedOn;     // to a function
layout(set = 0, binding = 7) readonly buffer Measured { uint measured[]; };  // its length alone
layout(set = 0, binding = 9) buffer Counted { uint counted; };    // by an atomic alone
layout(set = 0, binding = 10) readonly buffer Switched { uint switched[]; };  // behind a constant that is false
layout(set = 0, binding = 11) buffer Unused { uint unused[]; };
layout(set = 0, binding = 12) uniform usamplerBuffer unusedTexels;
layout(set = 0, binding = 13) readonly buffer Uncalled { uint uncalled[]; };  // by a function nobody calls
layout(set = 0, binding = 20) writeonly buffer Target { uint target[]; };

uint first(usamplerBuffer texels) { return texelFetch(texels, 0).x; }
uint inner() { return stored[0]; }
uint outer() { return inner() + first(handedOn); }
uint nobodyCalls() { return uncalled[0]; }

void main() {
  target[0] = outer() + shift.x + texelFetch(fetched, 1).y + uint(measured.length());
  atomicAdd(counted, 1);
  if (kOn) target[1] = switched[0];
}
