// The mean of all moments, as a screen shows it.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/picture.glsl"
#include "shared/tone.glsl"

layout(set = 0, binding = kBindPixels) readonly buffer Pixels { vec4 pixels[]; };
layout(set = 0, binding = kBindShown) writeonly buffer Shown { uint shown[]; };

void main() {
  uint pixel = gl_GlobalInvocationID.x;
  if (pixel >= picture.width * picture.height) return;
  vec3 light = pixels[pixel].rgb * (picture.exposure / max(pixels[pixel].w, 1.0));
  shown[pixel] = toned(light, pixel);
}
