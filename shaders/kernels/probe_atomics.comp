// Probe of `ringlet conform`: atomics from all invocations at once.
// results, initially zeros: [0] number of invocations, [1] sum of their values, [2] the largest, [3] unused;
// then, for each place that an invocation got by counting itself in [0], how many invocations got it.
#version 450

layout(local_size_x_id = 0) in;
layout(std430, set = 0, binding = 0) readonly buffer Values { uint values[]; };
layout(std430, set = 0, binding = 1) buffer Results { uint results[]; };

void main() {
  uint value = values[gl_GlobalInvocationID.x];
  uint place = atomicAdd(results[0], 1);
  atomicAdd(results[1], value);
  atomicMax(results[2], value);
  atomicAdd(results[4 + place], 1);
}
