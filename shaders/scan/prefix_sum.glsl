// Sums along a strand: the sum over all lanes closer to the root.
#ifndef RINGLET_PREFIX_SUM
#define RINGLET_PREFIX_SUM

#include "scan/lanes.glsl"

vec3 sumBeforeRun(vec3 sum) {
  [[unroll]] for (uint o = 1; o < kLanes; o *= 2) {
    vec3 before = fromRootward(sum, o);
    if (lane >= o) sum += before;
  }
  vec3 before = fromRootward(sum, 1);
  return lane == 0 ? vec3(0) : before;
}

#endif
