// Frames carried along the smoothed curve by parallel transport, Iben et al. 2012, section 3.2: each frame is the one
// before, turned by the smallest rotation between their edges' directions. Mirrored by reference/equations/frame.h.
#ifndef RINGLET_FRAME
#define RINGLET_FRAME

#include "maths/quaternion.glsl"

/// x / |x|, or `fallback` where x has no direction.
vec3 directionOr(vec3 x, vec3 fallback) {
  float squared = dot(x, x);
  return squared > 1e-30 ? x * inversesqrt(squared) : fallback;
}

/// The smallest rotation that takes the unit vector a to the unit vector b, less the identity: (x, y, z, w - 1). A chain
/// of a thousand of them then rounds by each turn's own smallness. Opposite vectors: a half turn about a perpendicular.
vec4 smallestTurn(vec3 a, vec3 b) {
  vec3 axis = cross(a, b);
  float c = max(0.0, 1.0 + dot(a, b));
  float squared = dot(axis, axis) + c * c;
  bool opposite = squared < 1e-10;
  axis = opposite ? (abs(a.x) < 0.7 ? vec3(0, a.z, -a.y) : vec3(-a.z, 0, a.x)) : axis;
  squared = opposite ? dot(axis, axis) : squared;
  float s = inversesqrt(squared);
  axis *= s;
  return vec4(axis, -dot(axis, axis) / (1.0 + c * s));
}

/// `frame` turned by a turn less the identity.
vec4 turned(vec4 turn, vec4 frame) { return frame + multiply(turn, frame); }

#endif
