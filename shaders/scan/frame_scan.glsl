// Carries frames across lanes: the product of turns from the root up to each lane.
#ifndef RINGLET_FRAME_SCAN
#define RINGLET_FRAME_SCAN

#include "maths/quaternion.glsl"
#include "scan/lanes.glsl"

/// `turn`: the product of this lane's turns. Returns the frame before the run: all earlier lanes' turns after `rootFrame`.
vec4 frameBeforeRun(vec4 turn, vec4 rootFrame) {
  if (kLanes == 1) return rootFrame;
  [[unroll]] for (uint o = 1; o < kLanes; o *= 2) {
    vec4 before = fromRootward(turn, o);
    if (lane >= o) turn = renormalized(multiply(turn, before));
  }
  vec4 before = fromRootward(turn, 1);
  return lane == 0 ? rootFrame : multiply(before, rootFrame);
}

#endif
