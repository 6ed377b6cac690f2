// One mode of the turbulent wind. Kraichnan, "Diffusion by a random velocity field", 1970:
//
//   w = sum of a_k cos(k . x + phase_k)        a_k across k, so that the wind has no divergence
//
// Phases run with time; ringlet/scene/wind.h makes the modes. Mirrored by reference/equations/turbulence.h.
#ifndef RINGLET_TURBULENCE
#define RINGLET_TURBULENCE

/// Subtracts whole turns from an angle of up to 1,000 turns [rad]: the result is in [-pi, pi].
float foldedAngle(float angle) {
  float turns = floor(angle * 0.15915494 + 0.5);
  // 2 pi in two parts, the first with so few digits that its product is exact.
  return (angle - turns * 6.28125) - turns * 0.0019353072;
}

/// cos() of an angle in [-pi, pi], as sin(pi / 2 - |angle|): an odd polynomial through Chebyshev nodes,
/// accurate to 2e-7. Vulkan guarantees only 2^-11 for cos(), and drivers differ.
float cosOfFolded(float angle) {
  float x = (1.57079637 - abs(angle)) - 4.37113883e-8;  // pi / 2 in two parts
  float squared = x * x;
  float tail = 0.00833303947 + squared * (-0.000198082023 + squared * 2.60323350e-6);
  return x * (1.0 + squared * (-0.166666582 + squared * tail));
}

/// wave [rad/m], amplitude [m/s], phase at x = 0 [rad], x [m]. Returns the wind [m/s].
vec3 windOfMode(vec3 wave, vec3 amplitude, float phase, vec3 x) {
  return cosOfFolded(foldedAngle(dot(wave, x) + phase)) * amplitude;
}

#endif
