// The turbulent wind. Mirrors shaders/equations/turbulence.glsl, and sums over the modes.
// Kraichnan, "Diffusion by a random velocity field", Physics of Fluids 13, 1970:
//
//     w(x, t) = sum over k of a_k cos(k . x + omega_k t + phi_k)          a_k . k = 0
//
// div w = - sum of (a_k . k) sin(...) = 0. The modes are those of ringlet/scene/wind.h.
#pragma once

#include <cmath>
#include <numbers>
#include <span>

#include "reference/fields.h"
#include "ringlet/scene/wind.h"

namespace ringlet::reference {

/// w [m/s] at origin + x [m], t [s]. What belongs to all x, k . origin + omega t + phi, is folded in double
/// whatever Real is, as it is on the host.
template <class Real>
Vector3<Real> turbulentWind(std::span<const WindMode> modes, const Vector3<double>& origin, double t,
                            const Vector3<Real>& x) {
  Vector3<Real> wind = Vector3<Real>::Zero();
  for (const WindMode& mode : modes) {
    const double phase = toEigen<double>(mode.wave).dot(origin) + mode.frequency * t + mode.phase;
    const Real folded = static_cast<Real>(std::remainder(phase, 2 * std::numbers::pi));
    wind += toEigen<Real>(mode.amplitude) * std::cos(toEigen<Real>(mode.wave).dot(x) + folded);
  }
  return wind;
}

}  // namespace ringlet::reference
