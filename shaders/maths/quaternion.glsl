// Unit quaternions as vec4 (x, y, z, w); multiply(a, b) rotates by b first, then by a.
#ifndef RINGLET_QUATERNION
#define RINGLET_QUATERNION

const vec4 kIdentity = vec4(0, 0, 0, 1);

vec4 multiply(vec4 a, vec4 b) {
  return vec4(a.w * b.xyz + b.w * a.xyz + cross(a.xyz, b.xyz), a.w * b.w - dot(a.xyz, b.xyz));
}

vec4 conjugate(vec4 q) { return vec4(-q.xyz, q.w); }

/// The displacement of x by the rotation q.
vec3 displacement(vec4 q, vec3 x) {
  vec3 t = 2.0 * cross(q.xyz, x);
  return q.w * t + cross(q.xyz, t);
}
vec3 rotate(vec4 q, vec3 x) { return x + displacement(q, x); }

/// One Newton step towards length 1: keeps a product of hundreds of rotations normalized.
vec4 renormalized(vec4 q) { return q * (1.5 - 0.5 * dot(q, q)); }

#endif
