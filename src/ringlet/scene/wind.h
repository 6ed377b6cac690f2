// The wind of AirSettings: the uniform wind with its gusts, and the modes whose sum is the turbulence. The
// same settings give the same wind.
#pragma once

#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/scene/air.h"

namespace ringlet {

inline constexpr int kWindModeCount = 12;

/// A wave of the turbulent wind: at x [m], t [s], amplitude cos(wave . x + frequency t + phase).
struct WindMode {
  Vec3d wave;            // points where it repeats, 2 pi over its length [rad/m]
  Vec3d amplitude;       // across `wave`, so that air neither gathers nor thins [m/s]
  double frequency = 0;  // [rad/s]
  double phase = 0;      // [rad]
};

/// Turbulence as random Fourier modes (Kraichnan, "Diffusion by a random velocity field", 1970):
/// kWindModeCount of them, or none where `turbulence` is 0. Each component's mean square over space is
/// turbulence^2.
std::vector<WindMode> windModes(const AirSettings& air);

/// What the mode's phase is at `origin` and time t, in [0, 2 pi): at origin + x it blows with amplitude
/// cos(wave . x + phaseAt(mode, origin, t)). In double, so that x may be a float near the origin.
double phaseAt(const WindMode& mode, Vec3d origin, double t);

/// The even wind at t seconds, without turbulence: wind (1 + gust s(t)), where s swells and sinks smoothly
/// between 0 and 1 with a mean of 1/2 and a crest every gustSeconds on average. Defined for t < 0 too.
Vec3d evenWindAt(const AirSettings& air, double t);

}  // namespace ringlet
