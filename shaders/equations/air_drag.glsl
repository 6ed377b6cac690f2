// Drag of the air on a particle, by the cross-flow principle (Hoerner, "Fluid-Dynamic Drag", 1965): the flow
// across a strand and the flow along it drag independently. Quadratic, as for wisps of hair at their Reynolds
// numbers. Mirrored by reference/equations/air_drag.h.
//
//   u = v - w, of the particle relative to the air [m/s];  t: the strand's tangent
//   u_along = t (t . u),  u_across = u - u_along
//   a = -(g / U^2) (|u_across| u_across + s |u_along| u_along)       g = 9.81 m/s^2, U: fall speed, s: share along
//
// The step is semi-implicit: both |u| are those at its start. D = T m (a_across (1 - t tᵀ) + a_along t tᵀ) is
// added to the mass block, D w to the right-hand side.
#ifndef RINGLET_AIR_DRAG
#define RINGLET_AIR_DRAG

#include "maths/symmetric.glsl"

/// Shares of its velocity relative to the air that a particle loses in a step, to first order.
struct AirDrag {
  float across;  // T a_across [1]
  float along;   // T a_along [1]
};

/// tangent: unit vector; or 0 for a particle without a direction, for which all flow counts as across.
/// strength: g / U^2 [1/m].
AirDrag airDrag(vec3 u, vec3 tangent, float strength, float alongShare, float T) {
  float along = dot(tangent, u);
  return AirDrag(T * strength * length(u - along * tangent), T * strength * alongShare * abs(along));
}

/// D x / m, of the same tangent.
vec3 multiply(AirDrag drag, vec3 tangent, vec3 x) {
  vec3 along = dot(tangent, x) * tangent;
  return drag.across * (x - along) + drag.along * along;
}

/// D, in the unit of the mass.
Symmetric airDragMatrix(AirDrag drag, vec3 tangent, float mass) {
  return addOuter(symmetricDiagonal(mass * drag.across), mass * (drag.along - drag.across), tangent);
}

#endif
