// Functions with shuffles: five that some lanes may leave out, in a way each, and five that none can. For
// shuffle_uniformity_test.cpp; never run.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "shared/workgroup.glsl"

layout(set = 0, binding = 0) buffer Numbers { uint numbers[]; };
layout(push_constant) uniform Parameters { uint turns; };
layout(constant_id = 2) const bool kAsks = true;

uint lane() { return gl_SubgroupInvocationID & 7; }
uint fromBefore(uint x) { return subgroupShuffle(x, gl_SubgroupInvocationID ^ 1); }

uint inChoice(uint x) { return lane() == 0 ? 0 : fromBefore(x); }
uint inIf(uint x) {
  if (numbers[gl_SubgroupInvocationID] > 3) x += fromBefore(x);
  return x;
}
uint behindReturn(uint x) {
  if (lane() > 3) return x;
  return fromBefore(x);
}
uint inLoop(uint x) {
  for (uint k = 0; k < lane(); ++k) x += fromBefore(x);
  return x;
}
uint askedBySome(uint x) { return fromBefore(x); }
uint throughCall(uint x) {
  bool is = false;
  if (lane() == 2) is = true;  // a constant, but not for all
  return is ? askedBySome(x) : x;
}

uint before(uint x) {
  uint other = fromBefore(x);
  return lane() == 0 ? 0 : other;
}
uint byConstant(uint x) { return kAsks ? fromBefore(x) : x; }
uint byParameter(uint x) {
  uint k = 0;
  if (turns > 0) do x += fromBefore(x);
    while (++k < turns);
  return x;
}
uint byOneNumber(uint x) { return numbers[turns] > 3 ? fromBefore(x) : x; }
bool isAnyOfSubgroup(bool x) { return fromBefore(x ? 1 : 0) > 0; }
uint together(uint x) {
  do x += fromBefore(x);
  while (isAnyOfSubgroup(x < lane()));
  return x;
}

void main() {
  uint x = gl_GlobalInvocationID.x;
  x = inChoice(x) + inIf(x) + behindReturn(x) + inLoop(x) + throughCall(x);
  numbers[gl_GlobalInvocationID.x] = before(x) + byConstant(x) + byParameter(x) + byOneNumber(x) + together(x);
}
