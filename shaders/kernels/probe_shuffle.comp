// Probe of `ringlet conform`: shuffles from every lane to every lane, by index and by xor.
// results, n being the number of invocations: [0 n, 1 n) subgroup size, [1 n, 2 n) lane, [2 n, 3 n) subgroup in its
// workgroup; then for each lane s two rows of n: the value of lane s, and the value of lane (own lane xor s).
#version 450
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require

layout(local_size_x_id = 0) in;
layout(std430, set = 0, binding = 0) readonly buffer Values { uint values[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Results { uint results[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  uint n = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  uint value = values[i];
  results[i] = gl_SubgroupSize;
  results[n + i] = gl_SubgroupInvocationID;
  results[2 * n + i] = gl_SubgroupID;
  uint s = 0;
  do {
    results[(3 + 2 * s) * n + i] = subgroupShuffle(value, s);
    results[(4 + 2 * s) * n + i] = subgroupShuffle(value, gl_SubgroupInvocationID ^ s);
  } while (++s < gl_SubgroupSize);
}
