// A field at a place x: an acceleration, or air that drags hair along ("easy integration of external forces":
// Iben et al. 2012, section 2). q is the vector from the field's place p to x, or its part across the axis a,
// and s = sqrt(q^2 + core^2):
//
//     F = w(|q|) (axial a + radial q / s + around (a x q) / s + grid(x))
//     w(d) = (1 - (d / reach)^2)^2 (1 - ((d - front) / thickness)^2)^2,   each factor 0 beyond its range
//
// Without drag F is an acceleration. With drag c it is the velocity of the air, and w multiplies the drag,
// which is implicit in the step:
//
//     (1 + T w c) v+ = ... + T w c F / w
//
// Mirrored by reference/equations/force_field.h.
#ifndef RINGLET_FORCE_FIELD
#define RINGLET_FORCE_FIELD

#include "layout/fields.h"

/// The vector q from the field's place, or from its axis.
vec3 fieldArm(StepField field, vec3 x) {
  vec3 q = x - field.place;
  return q - field.aboutAxis * dot(field.axis, q) * field.axis;
}

/// (1 - u^2)^2 for |u| < 1, else 0.
float fadedTo1(float u) {
  float rest = max(0.0, 1.0 - u * u);
  return rest * rest;
}
float fieldWeight(StepField field, float d) {
  return fadedTo1(d * field.perReach) * fadedTo1((d - field.front) * field.perThickness);
}

/// F without the grid and without the weight w.
vec3 fieldStrength(StepField field, vec3 q) {
  vec3 n = inversesqrt(max(dot(q, q) + field.core * field.core, 1e-20)) * q;
  return field.axial * field.axis + field.radial * n + field.around * cross(field.axis, n);
}

/// The terms that a field of strength F and weight w adds to a particle's system, per kilogram: xyz: to the
/// right-hand side [m/s]; w: to the mass.
vec4 fieldPull(StepField field, vec3 F, float w, float T) {
  if (field.drag > 0.0) return T * w * field.drag * vec4(F + field.still, 1.0);
  return vec4(T * w * F, 0.0);
}

#endif
