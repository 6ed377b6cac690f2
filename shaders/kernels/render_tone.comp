// From linear light to what a screen shows: a filmic curve (Narkowicz 2016, a fit of ACES), sRGB, and noise of one
// step, so that
// smooth shades have no bands.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/picture.glsl"

layout(set = 0, binding = kBindPixels) readonly buffer Pixels { vec4 pixels[]; };
layout(set = 0, binding = kBindShown) writeonly buffer Shown { uint shown[]; };

float encoded(float x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * exp2(log2(x) / 2.4) - 0.055; }

void main() {
  uint pixel = gl_GlobalInvocationID.x;
  if (pixel >= picture.width * picture.height) return;
  vec3 light = pixels[pixel].rgb * (picture.exposure / max(pixels[pixel].w, 1.0));
  vec3 film = clamp(light * (2.51 * light + 0.03) / (light * (2.43 * light + 0.59) + 0.14), 0.0, 1.0);
  vec3 screen = vec3(encoded(film.r), encoded(film.g), encoded(film.b)) + (unitOf(mixed(pixel)) - 0.5) / 255.0;
  shown[pixel] = packUnorm4x8(vec4(screen, 1));
}
