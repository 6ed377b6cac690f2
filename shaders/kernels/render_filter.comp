// Filters the light of each pixel, averaged over all moments, with that of its neighbours. A box filter of a
// pixel's own samples would make hairs thinner than a pixel flicker.
//
//   kEdge^2      kEdge kCentre  kEdge^2        kCentre = 1 - 2 kEdge; outside the picture edge pixels count
//   kEdge kCentre   kCentre^2   kEdge kCentre
//   kEdge^2      kEdge kCentre  kEdge^2
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/picture.glsl"

layout(set = 0, binding = kBindPixels) readonly buffer Pixels { vec4 pixels[]; };
layout(set = 0, binding = kBindLight) writeonly buffer Light { vec4 light[]; };

const float kEdge = 0.1;

float weightOf(int away) { return away == 0 ? 1.0 - 2.0 * kEdge : kEdge; }

void main() {
  uint pixel = gl_GlobalInvocationID.x;
  if (pixel >= picture.width * picture.height) return;
  int y = int(pixel / picture.width);
  int x = int(pixel) - y * int(picture.width);
  vec3 sum = vec3(0);
  for (int dy = -1; dy <= 1; ++dy) {
    uint row = uint(clamp(y + dy, 0, int(picture.height) - 1)) * picture.width;
    for (int dx = -1; dx <= 1; ++dx) {
      vec4 near = pixels[row + uint(clamp(x + dx, 0, int(picture.width) - 1))];
      sum += weightOf(dx) * weightOf(dy) / max(near.w, 1.0) * near.rgb;
    }
  }
  light[pixel] = vec4(sum, 1);
}
