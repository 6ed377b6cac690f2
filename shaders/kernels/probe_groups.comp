// Probe of `ringlet conform`: writes the group counts of an indirect dispatch.
#version 450

layout(local_size_x_id = 0) in;
layout(std430, set = 0, binding = 2) writeonly buffer Groups { uint groups[]; };
layout(push_constant) uniform Push { uint count; };

void main() {
  if (gl_GlobalInvocationID.x < 3) groups[gl_GlobalInvocationID.x] = gl_GlobalInvocationID.x == 0 ? count : 1;
}
