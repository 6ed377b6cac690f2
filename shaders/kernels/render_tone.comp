// Converts the light of pixels to display values.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/picture.glsl"
#include "shared/tone.glsl"

layout(set = 0, binding = kBindLight) readonly buffer Light { vec4 light[]; };
layout(set = 0, binding = kBindShown) writeonly buffer Shown { uint shown[]; };

void main() {
  uint pixel = gl_GlobalInvocationID.x;
  if (pixel >= picture.width * picture.height) return;
  shown[pixel] = toned(light[pixel].rgb * picture.exposure, pixel);
}
