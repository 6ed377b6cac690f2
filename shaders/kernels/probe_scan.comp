// Probe of `ringlet conform`: the running sum over each workgroup, through shared memory and barriers.
#version 450

layout(local_size_x_id = 0) in;
layout(std430, set = 0, binding = 0) readonly buffer Values { uint values[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Results { uint results[]; };

shared uint sums[gl_WorkGroupSize.x];

void main() {
  uint k = gl_LocalInvocationID.x;
  sums[k] = values[gl_GlobalInvocationID.x];
  for (uint reach = 1; reach < gl_WorkGroupSize.x; reach *= 2) {
    barrier();
    uint before = k >= reach ? sums[k - reach] : 0;
    barrier();
    sums[k] += before;
  }
  results[gl_GlobalInvocationID.x] = sums[k];
}
