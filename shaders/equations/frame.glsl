// Frames carried along the smoothed curve by parallel transport, Iben et al. 2012, section 3.2: each frame is the one
// before, turned by the smallest rotation between their edges' directions. Mirrored by reference/equations/frame.h.
#ifndef RINGLET_FRAME
#define RINGLET_FRAME

#include "maths/quaternion.glsl"

/// x / |x|; the zero vector for one without direction, to and from which no frame turns.
vec3 directionOf(vec3 x) { return x * inversesqrt(max(dot(x, x), 1e-30)); }

/// The smallest rotation that takes the unit vector a to the unit vector b, less the identity: (x, y, z, w - 1). A chain
/// of a thousand of them then rounds by each turn's own smallness. Between opposite vectors, where
/// none is the smallest: about the axis that rounding leaves, or none.
vec4 smallestTurn(vec3 a, vec3 b) {
  vec3 axis = cross(a, b);
  float c = 1.0 + dot(a, b);
  float s = inversesqrt(max(dot(axis, axis) + c * c, 1e-20));
  axis *= s;
  return vec4(axis, -dot(axis, axis) / (1.0 + c * s));
}

/// `frame` turned by a turn less the identity.
vec4 turned(vec4 turn, vec4 frame) { return frame + multiply(turn, frame); }

#endif
