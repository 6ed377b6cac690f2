// Carries frames across lanes. Each lane transports a normal of its own choice along its run; it differs from
// the frame's normal by one angle about the curve, which is the same for the whole run, and angles add up.
#ifndef RINGLET_FRAME_SCAN
#define RINGLET_FRAME_SCAN

#include "equations/frame.glsl"
#include "scan/lanes.glsl"

/// `normal`: normal with which this lane started, perpendicular to `direction`; `normalAfter`: the same at
/// the run's end. Returns cosine and sine of the angle from the lane's normals to the frames'; lane 0 starts
/// with the frame's own.
vec2 twistOfRun(vec3 direction, vec3 normal, vec3 normalAfter) {
  if (kLanes == 1) return vec2(1, 0);
  vec3 arriving = fromRootward(normalAfter, 1);
  vec2 twist = vec2(dot(arriving, normal), dot(arriving, cross(direction, normal)));
  twist *= inversesqrt(max(dot(twist, twist), 1e-20));
  if (lane == 0) twist = vec2(1, 0);
  [[unroll]] for (uint o = 1; o < kLanes; o *= 2) {
    vec2 before = fromRootward(twist, o);
    vec2 both = vec2(before.x * twist.x - before.y * twist.y, before.x * twist.y + before.y * twist.x);
    if (lane >= o) twist = both;
  }
  return twist;
}

#endif
