// The spring along an edge. Mirrors shaders/equations/stretch_spring.glsl.
// Iben et al. 2012, section 3.1, equation 1:
//
//     f_s = k_s (|e| - s) e^ + c_s (dv . e^) e^          e^ = e / |e|
//
// s is the rest length: |rest edge|, less what gravity preload asks for. The force is added to particle i and
// subtracted from particle i + 1.
#pragma once

#include "reference/fields.h"

namespace ringlet::reference {

/// Elastic part [N]: stiffness k_s [N/m], edge e and rest length s [m], direction e^. The lengths are
/// compared in double whatever Real is: they are nearly equal, and their rounding in float would be the
/// reference's own noise.
template <class Real>
Vector3<Real> stretchForce(Real stiffness, const Vector3<Real>& edge, const Vector3<Real>& direction,
                           Real restLength) {
  const double stretch = edge.template cast<double>().norm() - static_cast<double>(restLength);
  return stiffness * static_cast<Real>(stretch) * direction;
}

/// Damping part [N]: damping c_s [N s/m], velocity difference dv [m/s], direction e^.
template <class Real>
Vector3<Real> stretchDamping(Real damping, const Vector3<Real>& velocityDifference,
                             const Vector3<Real>& direction) {
  return damping * velocityDifference.dot(direction) * direction;
}

}  // namespace ringlet::reference
