// The picture that render_* kernels draw, the band of it that a dispatch draws, and its hairs
// (layout/picture.h).
#ifndef RINGLET_PICTURE
#define RINGLET_PICTURE

#include "layout/picture.h"
#include "shared/texels.glsl"
#include "shared/workgroup.glsl"

layout(set = 0, binding = kBindPicture) uniform Pictures { Picture picture; };
layout(push_constant) uniform Bands { PictureBand band; };

/// A pseudo-random integer (Wellons, the smaller variant of triple32).
uint mixed(uint x) {
  x = (x ^ x >> 16) * 0x7feb352du;
  x = (x ^ x >> 15) * 0x846ca68bu;
  return x ^ x >> 16;
}
/// A number in [0, 1).
float unitOf(uint x) { return float(x >> 8) / 16777216.0; }

/// A place along the camera's axes [m].
vec3 inView(vec3 x) {
  return vec3(dot(picture.view[0].xyz, x) + picture.view[0].w, dot(picture.view[1].xyz, x) + picture.view[1].w,
              dot(picture.view[2].xyz, x) + picture.view[2].w);
}
/// Position relative to the picture's upper left corner [samples].
vec2 inSamples(vec3 seen) {
  vec2 middle = 0.5 * vec2(picture.width, picture.height);
  return float(picture.side) * (middle + picture.focus / seen.z * vec2(seen.x, -seen.y));
}
/// Size of the band in samples: across, and down; and its first row of samples.
uvec2 bandSize() { return picture.side * uvec2(picture.width, band.rowCount); }
float bandTop() { return float(picture.side * band.firstRow); }

#endif
