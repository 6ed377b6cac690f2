// Drag of the air on a particle. Mirrors shaders/equations/air_drag.glsl.
// The cross-flow principle (Hoerner, "Fluid-Dynamic Drag", 1965): flow across a slender body and flow along
// it drag by themselves. Quadratic in the speed, as wisps of hair are at their Reynolds numbers:
//
//     a = -(g / U^2) (|u_across| u_across + s |u_along| u_along)
//
//     u = v - w               the particle's velocity relative to the air's [m/s]
//     u_along = t (t . u)     t: tangent of length 1; 0 where there is none, and then all of u is across
//     u_across = u - u_along
//
// U (AirSettings::fallSpeed) is the speed at which a strand that lies across its fall falls steadily, and
// U / sqrt(s) (s: alongShare) that of one that points along it. g belongs to that definition: it is not the
// scene's gravity.
//
// The implicit step is ours: |u_across| and |u_along| are those of its start, which leaves a law linear in u,
// m a = -(D / T) u. (M + ... + D) v+ = ... + D w. For motion along a line through still air that is exact:
// v / (1 + T g v / U^2) solves v' = -(g / U^2) v^2.
#pragma once

#include "reference/fields.h"
#include "ringlet/rest/material.h"
#include "ringlet/scene/air.h"

namespace ringlet::reference {

/// a [m/s^2] at u [m/s], tangent t.
template <class Real>
Vector3<Real> airDragAcceleration(const AirSettings& air, const Vector3<Real>& u, const Vector3<Real>& t) {
  const Vector3<Real> along = t * t.dot(u), across = u - along;
  const Real strength = static_cast<Real>(kStandardGravity / (air.fallSpeed * air.fallSpeed));
  return -strength * (across.norm() * across + static_cast<Real>(air.alongShare) * along.norm() * along);
}

/// D [kg], for a particle of `mass` [kg] that begins a step of T [s] at u [m/s], tangent t.
template <class Real>
Matrix3<Real> airDragMatrix(const AirSettings& air, const Vector3<Real>& u, const Vector3<Real>& t, Real mass,
                            Real T) {
  const Matrix3<Real> ontoTangent = t * t.transpose();
  const Matrix3<Real> ontoPlane = Matrix3<Real>::Identity() - ontoTangent;
  const Real strength = static_cast<Real>(kStandardGravity / (air.fallSpeed * air.fallSpeed));
  const Real across = strength * (ontoPlane * u).norm();
  const Real along = strength * static_cast<Real>(air.alongShare) * (ontoTangent * u).norm();
  return T * mass * (across * ontoPlane + along * ontoTangent);
}

}  // namespace ringlet::reference
