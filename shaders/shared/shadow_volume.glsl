// How much hair is in front of a place: two boxes of cells, one along each light, with the area of hair in
// front of each cell (deep opacity maps, Yuksel and Keyser 2008, with cells of equal depth); and how much of
// the sky is visible from a place.
#ifndef RINGLET_SHADOW_VOLUME
#define RINGLET_SHADOW_VOLUME

#include "shared/picture.glsl"

/// A place in a light's box.
vec3 inLight(uint light, vec3 x) {
  vec4 at = vec4(x, 1);
  return vec3(dot(picture.lightAxes[3 * light], at), dot(picture.lightAxes[3 * light + 1], at),
              dot(picture.lightAxes[3 * light + 2], at));
}
uint shadowCell(uint light, uvec3 cell) {
  return ((light * picture.shadowSlices + cell.z) * picture.shadowCells + cell.y) * picture.shadowCells + cell.x;
}
uint densityCell(uvec3 cell) { return (cell.z * picture.densityCells + cell.y) * picture.densityCells + cell.x; }

/// Weight of one of the eight cells around a place at offset `f` from the first.
float cornerWeight(vec3 f, uvec3 corner) {
  vec3 w = mix(1.0 - f, f, vec3(corner));
  return w.x * w.y * w.z;
}
uvec3 cornerOf(uint k) { return uvec3(k & 1, k >> 1 & 1, k >> 2); }

#ifdef RINGLET_READS_SHADOWS
layout(set = 0, binding = kBindShadows) readonly buffer Shadows { uint shadows[]; };
layout(set = 0, binding = kBindOpenness) readonly buffer Openness { float openness[]; };

/// Mean number of hairs between a light and a place.
float hairsBefore(uint light, vec3 x) {
  vec3 cells = vec3(picture.shadowCells, picture.shadowCells, picture.shadowSlices);
  vec3 place = inLight(light, x);
  if (any(lessThan(place.xy, vec2(0))) || any(greaterThan(place.xy, vec2(1))) || place.z < 0.0) return 0.0;
  place = clamp(place * cells - 0.5, vec3(0), cells - 1.001);
  uvec3 first = uvec3(place);
  float sum = 0.0;
  for (uint k = 0; k < 8; ++k)
    sum += cornerWeight(place - vec3(first), cornerOf(k)) * float(shadows[shadowCell(light, first + cornerOf(k))]);
  return sum / (picture.fixedPoint * picture.shadowCellArea);
}

/// Share of the sky that is visible from x.
float opennessAt(vec3 x) {
  float cells = float(picture.densityCells);
  vec3 place = (x - picture.densityBox.xyz) / picture.densityBox.w - 0.5;
  if (any(lessThan(place, vec3(-1))) || any(greaterThan(place, vec3(cells)))) return 1.0;
  place = clamp(place, vec3(0), vec3(cells - 1.001));
  uvec3 first = uvec3(place);
  float sum = 0.0;
  for (uint k = 0; k < 8; ++k)
    sum += cornerWeight(place - vec3(first), cornerOf(k)) * openness[densityCell(first + cornerOf(k))];
  return sum;
}
#else
layout(set = 0, binding = kBindShadows) buffer Shadows { uint shadows[]; };
layout(set = 0, binding = kBindDensity) buffer Density { uint density[]; };

/// Adds an object at a place: its area as seen by a light is areas[light], the mean from all directions
/// meanArea [m^2].
void addAt(vec3 x, vec2 areas, float meanArea) {
  for (uint light = 0; light < 2; ++light) {
    vec3 place = inLight(light, x);
    if (all(greaterThanEqual(place, vec3(0))) && all(lessThan(place, vec3(1)))) {
      uvec3 cell = uvec3(place * vec3(picture.shadowCells, picture.shadowCells, picture.shadowSlices));
      atomicAdd(shadows[shadowCell(light, cell)], uint(areas[light] * picture.fixedPoint + 0.5));
    }
  }
  vec3 place = (x - picture.densityBox.xyz) / picture.densityBox.w;
  if (all(greaterThanEqual(place, vec3(0))) && all(lessThan(place, vec3(picture.densityCells))))
    atomicAdd(density[densityCell(uvec3(place))], uint(meanArea * picture.fixedPoint + 0.5));
}
#endif
#endif
