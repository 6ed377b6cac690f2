// Smoothing of a strand's edges or velocity differences, and its transpose. Mirrors
// shaders/equations/smoothing.glsl. Iben et al. 2012, section 3.2.1, as two exponential filters in a row,
// root to tip:
//
//     d_i = 2(1-beta) d_{i-1} - (1-beta)^2 d_{i-2} + beta^2 x_i        beta = 1 - exp(-l / alpha)
//
// written as the cascade a += beta (x_i - a), d += beta (a - d): the expanded form above loses float
//. Deviation: the start is the caller's (the rest first edge carried by the root frame), not
// x_0, which would put a hinge at the root.
#pragma once

#include <cmath>

#include "reference/fields.h"

namespace ringlet::reference {

/// beta, the filter's share of the new edge [1], for a mean rest edge length l [m] and a smoothing length
/// alpha [m]. alpha = 0 gives 1: no smoothing.
inline double smoothingShare(double meanEdgeLength, double alpha) {
  return alpha > 0 ? -std::expm1(-meanEdgeLength / alpha) : 1.0;
}

/// smoothed_i = d_i; both filters start from `start`. Fields of one vector per edge, in any unit.
template <class Real>
void smooth(const Field<Real>& x, std::type_identity_t<Real> beta,
            const std::type_identity_t<Vector3<Real>>& start, Field<Real>& smoothed) {
  smoothed.resize(x.size());
  Vector3<Real> a = start, d = start;
  for (std::size_t i = 0; i < x.size(); ++i) {
    // With beta = 1 the sums below would round; the filter is then the identity, exactly.
    a = beta == Real(1) ? x[i] : Vector3<Real>(a + beta * (x[i] - a));
    d = beta == Real(1) ? a : Vector3<Real>(d + beta * (a - d));
    smoothed[i] = d;
  }
}

/// The transpose of `smooth` with zero start: sum smooth(x)_i . h_i = sum x_i . spread_i for every x.
/// The same cascade from the tip, zero beyond it. Our choice ("transposed core").
template <class Real>
void smoothTransposed(const Field<Real>& h, std::type_identity_t<Real> beta, Field<Real>& spread) {
  spread.resize(h.size());
  Vector3<Real> a = Vector3<Real>::Zero(), g = Vector3<Real>::Zero();
  for (std::size_t i = h.size(); i-- > 0;) {
    a = beta == Real(1) ? h[i] : Vector3<Real>(a + beta * (h[i] - a));
    g = beta == Real(1) ? a : Vector3<Real>(g + beta * (a - g));
    spread[i] = g;
  }
}

}  // namespace ringlet::reference
