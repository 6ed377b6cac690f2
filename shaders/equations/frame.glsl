// Frames along the smoothed curve by parallel transport, Iben et al. 2012, section 3.2: each frame is the one
// before, turned by the smallest rotation between the directions of their edges. Mirrored by
// reference/equations/frame.h.
#ifndef RINGLET_FRAME
#define RINGLET_FRAME

#include "maths/quaternion.glsl"

/// x / |x|; the zero vector if x has no direction; frames do not turn to or from it.
vec3 directionOf(vec3 x) { return x * inversesqrt(max(dot(x, x), 1e-30)); }

/// The smallest rotation that takes the unit vector a to the unit vector b, minus the identity: (x, y, z, w -
/// 1). The rounding error of a chain of a thousand rotations then scales with the small rotations themselves.
/// Opposite vectors have no smallest rotation: it is about the axis that rounding leaves, or none.
vec4 smallestTurn(vec3 a, vec3 b) {
  vec3 axis = cross(a, b);
  float c = 1.0 + dot(a, b);
  float s = inversesqrt(max(dot(axis, axis) + c * c, 1e-20));
  axis *= s;
  return vec4(axis, -dot(axis, axis) / (1.0 + c * s));
}

/// `frame` turned by a rotation minus the identity.
vec4 turned(vec4 turn, vec4 frame) { return frame + multiply(turn, frame); }

/// The same rotation for a vector perpendicular to a, in a third of the time: its reflection in the plane
/// between a and b is perpendicular to b. Keeps the vector's length for any a and b.
vec3 carriedNormal(vec3 normal, vec3 a, vec3 b) {
  vec3 h = a + b;
  return normal - (2.0 * dot(normal, h) / max(dot(h, h), 1e-20)) * h;
}

/// Some unit vector perpendicular to the unit vector a (Duff et al. 2017, Building an orthonormal basis,
/// revisited).
vec3 someNormal(vec3 a) {
  float s = a.z >= 0.0 ? 1.0 : -1.0;
  float t = -1.0 / (s + a.z);
  return vec3(1.0 + s * a.x * a.x * t, s * a.x * a.y * t, -s * a.x);
}

/// Cosine and sine of half the angle of the vector x, which is in (-pi, pi]. It avoids atan(), for which
/// Vulkan allows 4096 ulp, and which some drivers get wrong at -0. The larger value comes from a sum, the
/// smaller from a quotient.
vec2 halfAngle(vec2 x) {
  float size = length(x);
  float larger = sqrt(0.5 + 0.5 * abs(x.x) / size);
  float smaller = 0.5 * abs(x.y) / (size * larger);
  vec2 result = x.x >= 0.0 ? vec2(larger, smaller) : vec2(smaller, larger);
  return vec2(result.x, x.y < 0.0 ? -result.y : result.y);
}

/// The frame that takes unit vector a to b and the normal u of a to the normal v of b.
vec4 frameBetween(vec3 a, vec3 u, vec3 b, vec3 v) {
  vec3 h = a + b;
  float size = length(h);
  vec4 turn = size > 1e-6 ? vec4(cross(a, h) / size, 0.5 * size) : vec4(u, 0);
  vec3 carried = rotate(turn, u);
  vec2 halfTwist = halfAngle(vec2(dot(carried, v), dot(cross(carried, v), b)));
  return multiply(vec4(halfTwist.y * b, halfTwist.x), turn);
}

#endif
