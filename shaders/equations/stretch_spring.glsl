// Stretch spring, Iben et al. 2012, eq. 1, elastic part; the damping is part of the solve. Mirrored by
// reference/equations/stretch_spring.h.
vec3 stretchForce(float stiffness, float edgeLength, float restLength, vec3 edgeDirection) {
  return stiffness * (edgeLength - restLength) * edgeDirection;
}
