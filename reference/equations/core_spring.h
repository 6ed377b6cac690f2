// The spring along the curl's core, which keeps it from unwinding. Mirrors
// shaders/equations/core_spring.glsl. Iben et al. 2012, section 3.3, equation 4, on edges b and velocity
// differences nu smoothed with alpha_c:
//
//     h = k_c (|b| - |b_rest|) b^ + c_c (nu . b^) b^          b^ = b / |b|, 0 for b = 0
//
// Nonlinear (same section): both constants are scaled, per strand, by how far the core is elongated.
// Deviation: the implicit integrators put h on the particles through the transpose of the smoothing
// (smoothing.h), not on edge i, which would be no gradient and pump energy.
#pragma once

#include <algorithm>

#include "reference/fields.h"

namespace ringlet::reference {

/// Elastic part [N]: stiffness k_c [N/m], smoothed edge b and its rest length [m].
template <class Real>
Vector3<Real> coreForce(Real stiffness, const Vector3<Real>& smoothedEdge, Real restLength) {
  return stiffness * (smoothedEdge.norm() - restLength) * directionOr(smoothedEdge, Vector3<Real>::Zero());
}

/// Damping part [N]: damping c_c [N s/m], smoothed velocity difference nu [m/s].
template <class Real>
Vector3<Real> coreDamping(Real damping, const Vector3<Real>& smoothedVelocityDifference,
                          const Vector3<Real>& smoothedEdge) {
  const Vector3<Real> direction = directionOr(smoothedEdge, Vector3<Real>::Zero());
  return damping * smoothedVelocityDifference.dot(direction) * direction;
}

/// rho: length of the strand's smoothed curve over its rest length [1]; 1 where there is no rest length.
template <class Real>
Real coreElongation(const Field<Real>& smoothedEdges, std::type_identity_t<Real> restCoreLength) {
  Real coreLength = 0;
  for (const Vector3<Real>& b : smoothedEdges) coreLength += b.norm();
  return restCoreLength > Real(0) ? coreLength / restCoreLength : Real(1);
}

/// The share of the full constants in force: relaxedShare up to elongation `low`, 1 from `high` on, smooth
/// between.
template <class Real>
Real coreScale(Real elongation, Real low, Real high, Real relaxedShare) {
  if (high <= low) return elongation < high ? relaxedShare : Real(1);
  const Real s = std::clamp((elongation - low) / (high - low), Real(0), Real(1));
  return relaxedShare + (Real(1) - relaxedShare) * s * s * (Real(3) - Real(2) * s);
}

}  // namespace ringlet::reference
