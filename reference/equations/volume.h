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

/// a = kappa w + k T s [m/s], from w [m/s] and s [m].
inline Vector3<double> volumeRate(const ContactSettings& settings, double T, const Vector3<double>& w,
                                  const Vector3<double>& s) {
  return settings.volumeGain(T) * w + settings.volumeStiffness * T * s;
}

/// What the guess adds to v^0 [m/s], from the last step's change c [m/s] and what it gave, J / m [m/s].
inline Vector3<double> guessedChange(const ContactSettings& settings, double T, const Vector3<double>& c,
                                     const Vector3<double>& given) {
  return settings.volumeWarmth(T) * (c - given / (2 + settings.volumeGain(T)));
}

/// C from the gradient of A [1/s]; inCell: place in the cell [cells], 0 to 1.
inline Matrix3<double> keptGradient(const Matrix3<double>& gradient, const Vector3<double>& inCell) {
  const auto toFace = inCell.array().min(1 - inCell.array());
  const Vector3<double> f = (toFace / kVolumeRim).max(0.0).min(1.0).matrix();
  const Matrix3<double> inner = gradient * f.asDiagonal();
  return kVolumeGradient * (inner - std::min(inner.trace(), 0.0) / 3 * Matrix3<double>::Identity());
}

/// s a step later; moved: by how much in the head's frame [m].
inline Vector3<double> fadedDisplacement(const ContactSettings& settings, double T, const Vector3<double>& s,
                                         const Vector3<double>& moved) {
  return std::exp(-T / settings.volumeMemorySeconds) * (s + moved);
}

/// W, along each axis and as their product, at a node so many cells away.
inline Vector3<double> nodeWeights(const Vector3<double>& apart) {
  return (1 - apart.array().abs()).max(0.0).matrix();
}
inline double nodeWeight(const Vector3<double>& apart) { return nodeWeights(apart).prod(); }

/// grad W [1/cell].
inline Vector3<double> nodeGradient(const Vector3<double>& apart) {
  const Vector3<double> w = nodeWeights(apart);
  const auto slope = [&](int axis) { return apart[axis] < 0 ? 1.0 : -1.0; };
  return {slope(0) * w[1] * w[2], slope(1) * w[0] * w[2], slope(2) * w[0] * w[1]};
}

}  // namespace ringlet::reference
