// How well velocities solve the implicit system L v = r: |r - L v| over |r| and a step's gravity, T m 9.81 m/s^2,
// together. Without the gravity a hair at rest, whose r vanishes, would have no scale. Ours; the reference solves
// exactly.
#ifndef RINGLET_VELOCITY_RESIDUAL
#define RINGLET_VELOCITY_RESIDUAL

/// One particle's share of the scale, squared.
float residualScaleSquared(vec3 rightHandSide, float mass, float T) {
  float gravity = T * mass * 9.81;
  return dot(rightHandSide, rightHandSide) + gravity * gravity;
}

float velocityResidualShare(float residualSquared, float scaleSquared) {
  return sqrt(residualSquared / max(scaleSquared, 1e-30));
}

#endif
