// The relative residual of the implicit system L v = r: |r - L v| relative to |r| combined with a step's
// gravity, T m 9.81 m/s^2. Without gravity a hair at rest, for which r is 0, would have no scale. Our own;
// the reference solves exactly.
#ifndef RINGLET_VELOCITY_RESIDUAL
#define RINGLET_VELOCITY_RESIDUAL

/// The squared contribution of one particle to the scale.
float residualScaleSquared(vec3 rightHandSide, float mass, float T) {
  float gravity = T * mass * 9.81;
  return dot(rightHandSide, rightHandSide) + gravity * gravity;
}

float velocityResidualShare(float residualSquared, float scaleSquared) {
  return sqrt(residualSquared / max(scaleSquared, 1e-30));
}

#endif
