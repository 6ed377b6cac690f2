// Averages each pixel's samples and adds the result to the pictures before: one for each moment, with motion
// blur. A preview is shown at once, and all hair of a pixel has the colour of the sample that was shaded.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/picture.glsl"
#include "shared/sample_texels.glsl"
#include "shared/tone.glsl"

layout(set = 0, binding = kBindSolidColours) readonly buffer SolidColours { uvec2 solidColours[]; };
#ifdef RINGLET_PREVIEW
layout(set = 0, binding = kBindShown) writeonly buffer Shown { uint shown[]; };
#else
layout(set = 0, binding = kBindPixels) buffer Pixels { vec4 pixels[]; };
#endif

void main() {
  uint pixel = gl_GlobalInvocationID.x;
  if (pixel >= picture.width * band.rowCount) return;
  uint side = picture.side;
  uint stride = side * picture.width;
  uint y = pixel / picture.width;
  uint x = pixel - y * picture.width;
  uint first = y * side * stride + x * side;
  uint end = first + side * stride;
  vec3 hair = vec3(0);
  float hairs = 0.0;
  float solids = 0.0;
#ifdef RINGLET_PREVIEW
  float unshaded = 0.0;
#endif
  for (uint at = first; at < end; at += stride) {
    for (uint k = 0; k < side; ++k) {
      uvec2 what = sampleAt(at + k);
      bool isHair = (what.y & kShadedHair) != 0;
      vec3 colour = vec3(unpackHalf2x16(what.x), unpackHalf2x16(what.y & 0xffffu).x);
      hair += isHair ? colour : vec3(0);
      hairs += isHair ? 1.0 : 0.0;
      solids += !isHair && (what.x & kSolid) != 0 ? 1.0 : 0.0;
#ifdef RINGLET_PREVIEW
      unshaded += !isHair && what.x != 0 && (what.x & kSolid) == 0 ? 1.0 : 0.0;
#endif
    }
  }
#ifdef RINGLET_PREVIEW
  hair *= (hairs + unshaded) / max(hairs, 1.0);
  hairs += unshaded;
#endif
  uvec2 packed = solidColours[pixel];
  vec2 blue = unpackHalf2x16(packed.y);  // x: blue; y: the share that is covered
  y += band.firstRow;
  vec2 place = (vec2(x, y) + 0.5) / vec2(picture.width, picture.height) - vec2(0.45, 0.42);
  vec3 back = mix(picture.backColours[1].rgb, picture.backColours[0].rgb, exp(-2.2 * dot(place, place) * 1.5));
  vec3 solid = solids > 0.0 ? mix(back, vec3(unpackHalf2x16(packed.x), blue.x), blue.y) : vec3(0);
  float all = float(side * side);
  vec3 light = (hair + solids * solid + (all - hairs - solids) * back) / all;
#ifdef RINGLET_PREVIEW
  shown[y * picture.width + x] = toned(light * picture.exposure, y * picture.width + x);
#else
  pixels[y * picture.width + x] += vec4(light, 1);
#endif
}
