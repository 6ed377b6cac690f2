// Hair as a volume, one particle at a time. Mirrors shaders/equations/volume.glsl, where the model stands.
#pragma once

#include <algorithm>
#include <cmath>

#include "reference/fields.h"
#include "ringlet/scene/contact_settings.h"

namespace ringlet::reference {

/// o: share of the density about a particle that is not its own strand's [1].
inline double othersShare(double ownDensity, double density) {
  return density > 0 ? std::clamp(1 - ownDensity / density, 0.0, 1.0) : 0;
}

/// kappa = lambda T + k T^2 [1].
inline double volumeGain(const ContactSettings& settings, double T) {
  return settings.volumeDrag * T + settings.volumeStiffness * T * T;
}

/// a = kappa w + k T s [m/s], from w [m/s] and s [m].
inline Vector3<double> volumeRate(const ContactSettings& settings, double T, const Vector3<double>& w,
                                  const Vector3<double>& s) {
  return volumeGain(settings, T) * w + settings.volumeStiffness * T * s;
}

/// What the guess adds to v^0 [m/s], from the last step's change c [m/s] and what it gave, J / m [m/s].
inline Vector3<double> guessedChange(double gain, const Vector3<double>& c, const Vector3<double>& given) {
  return kVolumeWarmth * (c - given / (2 + gain));
}

/// s a step later; moved: by how much in the head's frame [m].
inline Vector3<double> fadedDisplacement(const ContactSettings& settings, double T, const Vector3<double>& s,
                                         const Vector3<double>& moved) {
  return std::exp(-T / settings.volumeMemorySeconds) * (s + moved);
}

/// W along one axis, of a node so many cells away.
inline double hat(double apart) { return std::max(0.0, 1 - std::abs(apart)); }

}  // namespace ringlet::reference
