// Lanes x run: a strand's particles are cut into kLanes runs of RUN consecutive ones, and each subgroup invocation
// keeps one run in registers. Several strands share a subgroup; kLanes is a power of two no larger than the subgroup.
//
//   strand   o-o-o-o | o-o-o-o | o-o-o-o | o-o          RUN = 4, kLanes = 4
//   lane        0         1         2       3
#ifndef RINGLET_LANES
#define RINGLET_LANES

#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require

layout(constant_id = kSpecLanes) const uint kLanes = 1;
// 4 to 64; arrays of such a size GLSL copies only element by element.
layout(constant_id = kSpecRun) const int RUN = 16;

uint lane;  // this invocation's place along its strand, 0 at the root

void findLane() { lane = gl_SubgroupInvocationID & (kLanes - 1); }

// Source invocation `offset` lanes towards the root or the tip; where there is none, this one itself, whose value the
// caller must not use.
uint rootward(uint offset) { return lane >= offset ? gl_SubgroupInvocationID - offset : gl_SubgroupInvocationID; }
uint tipward(uint offset) {
  return lane + offset < kLanes ? gl_SubgroupInvocationID + offset : gl_SubgroupInvocationID;
}

float fromRootward(float x, uint offset) { return subgroupShuffle(x, rootward(offset)); }
vec2 fromRootward(vec2 x, uint offset) { return subgroupShuffle(x, rootward(offset)); }
vec3 fromRootward(vec3 x, uint offset) { return subgroupShuffle(x, rootward(offset)); }
vec4 fromRootward(vec4 x, uint offset) { return subgroupShuffle(x, rootward(offset)); }
vec3 fromTipward(vec3 x, uint offset) { return subgroupShuffle(x, tipward(offset)); }

/// The sum over the strand's lanes, the same bits in each.
float sumOverStrand(float x) {
  [[unroll]] for (uint o = 1; o < kLanes; o *= 2) x += subgroupShuffle(x, gl_SubgroupInvocationID ^ o);
  return x;
}
uint sumOverStrand(uint x) {
  [[unroll]] for (uint o = 1; o < kLanes; o *= 2) x += subgroupShuffle(x, gl_SubgroupInvocationID ^ o);
  return x;
}
float maxOverStrand(float x) {
  [[unroll]] for (uint o = 1; o < kLanes; o *= 2) x = max(x, subgroupShuffle(x, gl_SubgroupInvocationID ^ o));
  return x;
}
uint minOverStrand(uint x) {
  [[unroll]] for (uint o = 1; o < kLanes; o *= 2) x = min(x, subgroupShuffle(x, gl_SubgroupInvocationID ^ o));
  return x;
}

#endif
