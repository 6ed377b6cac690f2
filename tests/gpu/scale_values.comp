// The kernel of the gpu tests: target[i] = factor source[i] + kOffset + shift[0] for every i below count.
// Source and target are apart, and the source is marked readonly: only so does the validation layer of Vulkan 1.3.239
// see a missing barrier. Between two buffers that are both written it keeps silent.
#version 450

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint kOffset = 0;

layout(std430, set = 0, binding = 0) readonly buffer Source { uint source[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Target { uint target[]; };
layout(std140, set = 0, binding = 2) uniform Shift { uvec4 shift; };
layout(push_constant) uniform Push { uint count; uint factor; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < count) target[i] = factor * source[i] + kOffset + shift[0];
}
