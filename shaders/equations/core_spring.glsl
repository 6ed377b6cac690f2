// Core spring, Iben et al. 2012, section 3.3, eq. 4: keeps a curl from unwinding. b: edge of the smoothed
// curve; nu: velocity difference, smoothed in the same way. Mirrored by reference/equations/core_spring.h.
#ifndef RINGLET_CORE_SPRING
#define RINGLET_CORE_SPRING

/// Elastic and damping part for one edge of given direction and length, before the blend.
vec3 coreForce(float stiffness, float damping, vec3 direction, float edgeLength, float restLength, vec3 nu) {
  return (stiffness * (edgeLength - restLength) + damping * dot(nu, direction)) * direction;
}

/// The share of the full constants at core elongation rho (the paper's nonlinear core; the limits are our
/// own).
float coreBlend(float rho, float relaxedShare, float low, float high) {
  return mix(relaxedShare, 1.0, smoothstep(low, high, rho));
}

#endif
