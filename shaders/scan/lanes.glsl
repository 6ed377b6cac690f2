// Lanes x run: a strand's particles are cut into kLanes runs of RUN consecutive ones, and each subgroup
// invocation keeps one run, in registers or with RINGLET_IN_MEMORY in its own memory. Several strands share a
// subgroup; kLanes is a power of two no larger than the subgroup. With RINGLET_ONE_LANE a strand has one
// lane, also on devices without subgroup operations; values from other lanes are then never used.
//
//   strand   o-o-o-o | o-o-o-o | o-o-o-o | o-o          RUN = 4, kLanes = 4
//   lane        0         1         2       3
#ifndef RINGLET_LANES
#define RINGLET_LANES

#include "layout/strands.h"
#include "shared/workgroup.glsl"

// 4 to 64, in memory 1,024; arrays of such a size GLSL copies only element by element.
layout(constant_id = kSpecRun) const int RUN = 16;
// Before every loop over a run. In registers it must be unrolled: an array that is indexed by a variable
// anywhere lives in memory, lane by lane (lavapipe: 6 x slower).
#ifdef RINGLET_IN_MEMORY
#define RINGLET_OVER_RUN [[dont_unroll]]
const bool kInMemory = true;
// Loops over a run end here: at RUN, which the kernel sets from a number that no compiler knows. NVIDIA's
// compiler unrolls loops whose end it knows, whatever the hint, and then cannot compile runs of 48 and more.
int runEnd;
#else
#define RINGLET_OVER_RUN [[unroll]]
const bool kInMemory = false;
const int runEnd = RUN;
#endif

#ifdef RINGLET_ONE_LANE

const uint kLanes = 1;
const uint lane = 0;

void findLane() {}
uint invocationOfDispatch() { return gl_GlobalInvocationID.x; }

float fromRootward(float x, uint offset) { return x; }
vec2 fromRootward(vec2 x, uint offset) { return x; }
vec3 fromRootward(vec3 x, uint offset) { return x; }
vec4 fromRootward(vec4 x, uint offset) { return x; }
vec3 fromTipward(vec3 x, uint offset) { return x; }

float sumOverStrand(float x) { return x; }
uint sumOverStrand(uint x) { return x; }
float maxOverStrand(float x) { return x; }
uint minOverStrand(uint x) { return x; }
bool isAnyOfSubgroup(bool x) { return x; }

#else

#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require

layout(constant_id = kSpecLanes) const uint kLanes = 1;

uint lane;  // index of this invocation along its strand, 0 at the root

void findLane() { lane = gl_SubgroupInvocationID & (kLanes - 1); }
uint invocationOfDispatch() {
  return gl_WorkGroupID.x * gl_WorkGroupSize.x + gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID;
}

// Shuffles must be called by all lanes of a subgroup, and never in an `if`, `?:`, && or || on a condition
// that differs between them: GLSL runs only one side of these, and lanes that do not take part return
// nothing. Returns the source invocation `offset` lanes towards the root or the tip; if there is none, this
// one itself, whose value the caller must not use.
uint rootward(uint offset) { return gl_SubgroupInvocationID - (lane >= offset ? offset : 0u); }
uint tipward(uint offset) { return gl_SubgroupInvocationID + (lane + offset < kLanes ? offset : 0u); }

float fromRootward(float x, uint offset) { return subgroupShuffle(x, rootward(offset)); }
vec2 fromRootward(vec2 x, uint offset) { return subgroupShuffle(x, rootward(offset)); }
vec3 fromRootward(vec3 x, uint offset) { return subgroupShuffle(x, rootward(offset)); }
vec4 fromRootward(vec4 x, uint offset) { return subgroupShuffle(x, rootward(offset)); }
vec3 fromTipward(vec3 x, uint offset) { return subgroupShuffle(x, tipward(offset)); }

/// The sum over the strand's lanes, with the same bits in each.
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

/// For loops with shuffles: all strands of a subgroup leave them together, and those that finish earlier are
/// not changed any more. Lanes that had left would return nothing, or on some drivers disturb the others.
bool isAnyOfSubgroup(bool x) {
  uint any = x ? 1 : 0;
  for (uint o = 1; o < gl_SubgroupSize; o *= 2) any |= subgroupShuffle(any, gl_SubgroupInvocationID ^ o);
  return any != 0;
}

#endif

#endif
