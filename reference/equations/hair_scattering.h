// Light that a hair scatters, far away from it: d'Eon et al. 2011 along the hair, Marschner et al. 2003 about
// it. The equation and its fits are those of shaders/equations/hair_scattering.glsl; what they are fits of is
// at the end of this file: a dielectric fibre of refractive index 1.55, rays across its width.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/fields.h"

namespace ringlet::reference {

inline constexpr double kHairIndex = 1.55;

struct HairFibre {
  Vector3<double> absorption;  // over the fibre's radius
  double along = 0.08;         // variance of R along the hair [rad^2]
  double about = 0.3;          // standard deviation of the roughness about the hair [rad]
  double tilt = 0;             // of the cuticle's scales [rad]
};

/// I_0(x) exp(-x), by its power series or, for large x, its asymptotic one.
inline double besselScaled(double x) {
  if (x > 30) {
    double term = 1, sum = 1;
    for (int k = 1; k < 12; ++k) sum += term *= (2 * k - 1) * (2 * k - 1) / (8 * x * k);
    return sum / std::sqrt(2 * std::numbers::pi * x);
  }
  double term = 1, sum = 1;
  for (int k = 1; k < 100; ++k) sum += term *= x * x / (4.0 * k * k);
  return sum * std::exp(-x);
}

/// M of variance v between two elevations [rad].
inline double alongHair(double v, double in, double out) {
  return besselScaled(std::cos(in) * std::cos(out) / v) * std::exp((std::cos(in + out) - 1) / v) /
         (v * (1 - std::exp(-2 / v)));
}

/// Share that a dielectric surface reflects, by the cosine of incidence.
inline double reflectedShare(double cosine) {
  const double inside = std::sqrt(1 - (1 - cosine * cosine) / (kHairIndex * kHairIndex));
  const double p = (kHairIndex * cosine - inside) / (kHairIndex * cosine + inside);
  const double s = (cosine - kHairIndex * inside) / (cosine + kHairIndex * inside);
  return (p * p + s * s) / 2;
}

/// A fit of its mean over a fibre's width.
inline double meanReflectedShare(double cosineHalf) {
  const double u = 1 - cosineHalf;
  return 0.0730 + u * (0.1470 + u * (-0.6637 + u * (2.9805 + u * (-4.1778 + u * 2.6327))));
}

inline double bell(double x, double deviation) {
  return std::exp(-x * x / (2 * deviation * deviation)) / (deviation * std::sqrt(2 * std::numbers::pi));
}

/// The lobes' parts that depend on theta_d: their shares of the light without absorption, the deviation of N,
/// and how far light goes in the fibre, over its radius.
struct HairLobes {
  double entered, again, rest;        // A of TT, TRT and all after; of R it is 1 - their sum
  double spreadThrough, spreadAgain;  // of N_TT about pi and N_TRT about 0, without roughness [rad]
  double way;                         // of TT
};
inline HairLobes hairLobes(double cosineHalf) {
  const double squared = 1 - cosineHalf * cosineHalf, beyond = 1 / cosineHalf - 1;
  const double mean = meanReflectedShare(cosineHalf), entered = (1 - mean) * (1 - mean);
  const double again = 0.87 * entered * mean;
  return {entered,
          again,
          0.996 - mean - entered - again,
          0.55 * (1 + 0.65 * beyond),
          0.06 + 0.7 * std::abs(beyond - 0.2),
          2 * (0.932 + 0.06 * squared) / std::sqrt(1 - squared / (kHairIndex * kHairIndex))};
}

/// S times cos theta_i, of elevations and the azimuth between [rad].
inline Vector3<double> scatteredByHair(const HairFibre& fibre, double in, double out, double phi) {
  const double halfway = std::clamp(std::cos((in - out) / 2), 0.2, 1.0);
  const HairLobes lobes = hairLobes(halfway);
  const Vector3<double> through = (-lobes.way * fibre.absorption.array()).exp().matrix();
  const Vector3<double> twice = through.cwiseProduct(through);
  const auto along = [&](double variances, double tilts) {
    const double tilt = std::atan(tilts * fibre.tilt);
    return alongHair(variances * fibre.along, in - tilt, out - tilt);
  };
  const double halfPhi = std::cos(phi / 2);
  const double wide = along(4, -1.5);
  Vector3<double> sum =
      Vector3<double>::Constant(along(1, 1) * halfPhi / 4 * reflectedShare(halfway * halfPhi));
  sum += lobes.entered * along(0.25, -0.5) *
         bell(std::numbers::pi - phi, std::hypot(lobes.spreadThrough, fibre.about)) * through;
  sum += wide * lobes.again * bell(phi, std::hypot(lobes.spreadAgain, fibre.about)) * twice;
  sum += wide * lobes.rest / (2 * std::numbers::pi) * twice.cwiseProduct(through);
  const double greater = std::max(std::cos(in), std::cos(out)), less = std::min(std::cos(in), std::cos(out));
  return sum * (std::cos(in) / (std::pow(greater, 0.75) * std::pow(less, 0.25)));
}

/// Of a ray that meets the fibre at h of its radius from the axis, in [-1, 1], and is reflected inside p - 1
/// times (p = 0: R).
struct FibreRay {
  double share = 0;    // of its light that leaves so
  double azimuth = 0;  // at which it leaves, over that at which it comes [rad]
  double way = 0;      // through the fibre, over its radius
};
inline FibreRay fibreRay(int p, double h, double cosineHalf) {
  const double squared = 1 - cosineHalf * cosineHalf;
  const double index = std::sqrt(kHairIndex * kHairIndex - squared) / cosineHalf;  // seen across the fibre
  const double in = std::asin(h), inside = std::asin(h / index);
  const double reflected = reflectedShare(cosineHalf * std::cos(in));
  if (p == 0) return {reflected, -2 * in, 0};
  return {(1 - reflected) * (1 - reflected) * std::pow(reflected, p - 1),
          2 * p * inside - 2 * in + p * std::numbers::pi,
          2 * p * std::cos(inside) / std::sqrt(1 - squared / (kHairIndex * kHairIndex))};
}

}  // namespace ringlet::reference
