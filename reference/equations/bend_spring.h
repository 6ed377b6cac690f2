// The spring that keeps an edge at its place in the frame. Mirrors shaders/equations/bend_spring.glsl.
// Iben et al. 2012, section 3.2, equation 3:
//
//     f_b = k_b (e - t) + c_b (dv - (dv . e^) e^)          t = F_{i-1} (rest target of edge i)
//
// Damping acts across the edge only; along it the stretch spring does. The force is added to particle i and
// subtracted from particle i + 1; the torque the frame would take up is left out, as in the paper.
#pragma once

#include <algorithm>

#include "reference/fields.h"

namespace ringlet::reference {

/// Elastic part [N]: stiffness k_b [N/m], edge e and target t [m].
template <class Real>
Vector3<Real> bendForce(Real stiffness, const Vector3<Real>& edge, const Vector3<Real>& target) {
  return stiffness * (edge - target);
}

/// Damping part [N]: damping c_b [N s/m], velocity difference dv [m/s], direction e^.
template <class Real>
Vector3<Real> bendDamping(Real damping, const Vector3<Real>& velocityDifference,
                          const Vector3<Real>& direction) {
  return damping * (velocityDifference - velocityDifference.dot(direction) * direction);
}

/// Backward Euler damps by itself, as T k_b would: take that off c_b, but keep half. Our choice.
inline double compensatedBendDamping(double damping, double stiffness, double stepSeconds) {
  return std::max(damping - stepSeconds * stiffness, damping / 2);
}

}  // namespace ringlet::reference
