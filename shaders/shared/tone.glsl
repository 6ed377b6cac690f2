// Converts linear light to display values: a filmic curve (Narkowicz 2016, a fit of ACES), sRGB, and noise of
// one level, so that smooth gradients show no bands.
#ifndef RINGLET_TONE
#define RINGLET_TONE

#include "shared/picture.glsl"

#ifdef RINGLET_PREVIEW
// Square roots instead of powers; the error is below one level of 255.
float encoded(float x) {
  float root = sqrt(x);
  float fourth = sqrt(root);
  return x <= 0.0031308 ? 12.92 * x : 0.585122381 * root + 0.783140355 * fourth - 0.368262736 * sqrt(fourth);
}
#else
float encoded(float x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * exp2(log2(x) / 2.4) - 0.055; }
#endif

/// Red in the lowest byte, then green, blue, 255.
uint toned(vec3 light, uint pixel) {
  vec3 film = clamp(light * (2.51 * light + 0.03) / (light * (2.43 * light + 0.59) + 0.14), 0.0, 1.0);
  vec3 screen = vec3(encoded(film.r), encoded(film.g), encoded(film.b)) + (unitOf(mixed(pixel)) - 0.5) / 255.0;
  return packUnorm4x8(vec4(screen, 1));
}

#endif
