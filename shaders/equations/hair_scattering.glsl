// Light that a hair scatters, seen from far away: d'Eon et al. 2011 along the hair, Marschner et al. 2003
// about it. Light that arrives at elevation theta_i is scattered into elevation theta_o and azimuth phi with
//
//     S = sum over p of A_p(theta_d) N_p(phi) M_p(theta_i, theta_o) / (greater^(3/4) less^(1/4))
//
// p: reflected (R), transmitted (TT), once reflected inside (TRT), and all the rest. theta_d: half the
// difference of the elevations. M_p is normalized over theta_o, N_p over phi; A_p are shares of the light,
// whose sum is slightly below 1 in hair without absorption. The last factor uses the greater and the lesser
// of cos theta_i and cos theta_o; it makes S symmetric in both directions, and these powers keep nearly all
// light. A_p, N_TT and N_TRT are fits to the integrals over a fibre of refractive index 1.55, which
// tests/equations/hair_scattering_test.cpp computes. Mirrored by reference/equations/hair_scattering.h.
#ifndef RINGLET_HAIR_SCATTERING
#define RINGLET_HAIR_SCATTERING

struct HairFibre {
  vec3 absorption;  // of the fibre, over its radius
  float along;      // variance of R along the hair [rad^2]
  float about;      // standard deviation of the roughness about the hair [rad]
  float tilt;       // of the cuticle's scales [rad]
};

const float kHairIndex = 1.55;

/// I_0(x) exp(-x), the modified Bessel function, to 0.4 % (Olivares et al. 2018); x >= 0.
float besselScaled(float x) {
  float squared = x * x;
  return (0.5 + 0.5 * exp(-2.0 * x)) * inversesqrt(sqrt(1.0 + 0.25 * squared)) * (1.0 + 0.24273 * squared) /
         (1.0 + 0.43023 * squared);
}

/// M with variance v between elevations of the given sines and cosines; largest for opposite elevations.
float alongHair(float v, float sineIn, float cosineIn, float sineOut, float cosineOut) {
  float inverse = 1.0 / v;
  float apart = (cosineIn * cosineOut - sineIn * sineOut - 1.0) * inverse;  // (cos(theta_i + theta_o) - 1) / v
  return besselScaled(cosineIn * cosineOut * inverse) * exp(apart) * inverse / (1.0 - exp(-2.0 * inverse));
}

/// Share that a dielectric surface reflects (Fresnel), as a function of the cosine of incidence.
float reflectedShare(float cosine) {
  float inside = sqrt(1.0 - (1.0 - cosine * cosine) / (kHairIndex * kHairIndex));
  float p = (kHairIndex * cosine - inside) / (kHairIndex * cosine + inside);
  float s = (cosine - kHairIndex * inside) / (cosine + kHairIndex * inside);
  return 0.5 * (p * p + s * s);
}

/// The same, averaged over a fibre's width.
float meanReflectedShare(float cosineHalf) {
  float u = 1.0 - cosineHalf;
  return 0.0730 + u * (0.1470 + u * (-0.6637 + u * (2.9805 + u * (-4.1778 + u * 2.6327))));
}

/// Gaussian, exp(-(x / deviation)^2 / 2), normalized; x must be far below a whole turn.
float bell(float x, float deviation) {
  float y = x / deviation;
  return 0.39894228 / deviation * exp(-0.5 * y * y);
}

/// The angle in [0, pi] with this cosine, within 7e-5 (Abramowitz and Stegun 4.4.45).
float angleOf(float cosine) {
  float a = abs(cosine);
  float angle = sqrt(max(1.0 - a, 0.0)) * (1.5707288 + a * (-0.2121144 + a * (0.0742610 - a * 0.0187293)));
  return cosine < 0.0 ? 3.14159265 - angle : angle;
}

/// Sine and cosine of an elevation after a tilt by a small angle.
vec2 tilted(float sine, float cosine, float angle) {
  return vec2(sine - cosine * angle, abs(cosine + sine * angle)) * inversesqrt(1.0 + angle * angle);
}

/// S times cos theta_i: radiance towards the eye over irradiance perpendicular to the light's direction. All
/// vectors are unit vectors, `tangent` from root to tip, the others away from the hair.
vec3 scatteredByHair(HairFibre fibre, vec3 tangent, vec3 towardsLight, vec3 towardsEye) {
  float sineIn = clamp(dot(tangent, towardsLight), -1.0, 1.0);
  float sineOut = clamp(dot(tangent, towardsEye), -1.0, 1.0);
  float cosineIn = sqrt(max(1.0 - sineIn * sineIn, 1e-6));
  float cosineOut = sqrt(max(1.0 - sineOut * sineOut, 1e-6));
  float cosinePhi = clamp((dot(towardsLight, towardsEye) - sineIn * sineOut) / (cosineIn * cosineOut), -1.0, 1.0);
  float phi = angleOf(cosinePhi);
  float cosineHalf = sqrt(clamp(0.5 + 0.5 * (cosineIn * cosineOut + sineIn * sineOut), 0.04, 1.0));  // cos theta_d
  float sineSquared = 1.0 - cosineHalf * cosineHalf;
  float beyond = 1.0 / cosineHalf - 1.0;

  float mean = meanReflectedShare(cosineHalf);
  float entered = (1.0 - mean) * (1.0 - mean);
  float again = 0.87 * entered * mean;
  float inverseInside = inversesqrt(1.0 - sineSquared / (kHairIndex * kHairIndex));
  vec3 through = exp(fibre.absorption * (-2.0 * (0.932 + 0.06 * sineSquared) * inverseInside));
  vec3 twice = through * through;  // of TRT, whose path is within 4 % of twice that of TT

  // R leaves at the angle at which it arrives; the share that is reflected to phi is that of the place on the
  // fibre which reflects light there.
  float halfPhi = sqrt(0.5 + 0.5 * cosinePhi);
  vec2 light = tilted(sineIn, cosineIn, fibre.tilt);
  vec2 eye = tilted(sineOut, cosineOut, fibre.tilt);
  vec3 sum = vec3(alongHair(fibre.along, light.x, light.y, eye.x, eye.y) * 0.25 * halfPhi *
                  reflectedShare(cosineHalf * halfPhi));

  float spread = 0.55 * (1.0 + 0.65 * beyond);
  light = tilted(sineIn, cosineIn, -0.5 * fibre.tilt);
  eye = tilted(sineOut, cosineOut, -0.5 * fibre.tilt);
  sum += (entered * alongHair(0.25 * fibre.along, light.x, light.y, eye.x, eye.y) *
          bell(3.14159265 - phi, sqrt(spread * spread + fibre.about * fibre.about))) * through;

  spread = 0.06 + 0.7 * abs(beyond - 0.2);
  light = tilted(sineIn, cosineIn, -1.5 * fibre.tilt);
  eye = tilted(sineOut, cosineOut, -1.5 * fibre.tilt);
  float wide = alongHair(4.0 * fibre.along, light.x, light.y, eye.x, eye.y);
  sum += wide * (again * bell(phi, sqrt(spread * spread + fibre.about * fibre.about)) * twice +
                 0.15915494 * (0.996 - mean - entered - again) * twice * through);
  return sum * (cosineIn * inversesqrt(max(cosineIn, cosineOut) * sqrt(cosineIn * cosineOut)));
}

#endif
