// Core spring, Iben et al. 2012, section 3.3, eq. 4: keeps a curl from unwinding. b is an edge of the smoothed curve,
// nu the velocity difference smoothed likewise. Mirrored by reference/equations/core_spring.h.
#ifndef RINGLET_CORE_SPRING
#define RINGLET_CORE_SPRING

/// Elastic and damping part for one edge, before the blend.
vec3 coreForce(float stiffness, float damping, vec3 b, float restLength, vec3 nu) {
  float squared = dot(b, b);
  if (squared < 1e-30) return vec3(0);
  float inverseLength = inversesqrt(squared);
  vec3 direction = b * inverseLength;
  return (stiffness * (squared * inverseLength - restLength) + damping * dot(nu, direction)) * direction;
}

/// The share of the full constants at core elongation rho (the paper's nonlinear core; its limits are ours).
float coreBlend(float rho, float relaxedShare, float low, float high) {
  return mix(relaxedShare, 1.0, smoothstep(low, high, rho));
}

#endif
