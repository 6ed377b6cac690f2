// Distance of a place from a body's surface, and the direction outwards, in the body's own frame. Mirrored by
// reference/equations/body_distance.h.
#ifndef RINGLET_BODY_DISTANCE
#define RINGLET_BODY_DISTANCE

#include "layout/bodies.h"

/// distance: negative inside [m]; normal: unit vector, outwards.
struct Surface {
  float distance;
  vec3 normal;
};

/// A box, enlarged by `rounding` with rounded edges and corners. Without extents it is a sphere, with one a
/// capsule.
Surface boxDistance(vec3 halfExtents, float rounding, vec3 y) {
  vec3 beyond = abs(y) - halfExtents;
  vec3 outside = max(beyond, 0.0);
  float outer = length(outside);
  float inner = max(beyond.x, max(beyond.y, beyond.z));
  vec3 nearest = beyond.x == inner ? vec3(1, 0, 0) : beyond.y == inner ? vec3(0, 1, 0) : vec3(0, 0, 1);
  vec3 way = outer > 0.0 ? outside / outer : nearest;
  return Surface((outer > 0.0 ? outer : inner) - rounding, vec3(y.x < 0.0 ? -way.x : way.x, y.y < 0.0 ? -way.y : way.y,
                                                                y.z < 0.0 ? -way.z : way.z));
}

Surface planeDistance(float rounding, vec3 y) { return Surface(y.y - rounding, vec3(0, 1, 0)); }

/// Any shape except a grid.
Surface solidDistance(uint shape, vec3 halfExtents, float rounding, vec3 y) {
  if (shape == kShapeBox) return boxDistance(halfExtents, rounding, y);
  return planeDistance(rounding, y);
}

/// corners: distances at a cell's corners (halves, two along x in each word: y z, Y z, y Z, Y Z) [cells]; f:
/// the place in the cell [cells]; beyond: vector from the grid to the place [cells]. The surface lies within
/// the grid, so a place at distance a from the grid's nearest place c is at least sqrt(a^2 + distance(c)^2)
/// from it.
Surface gridDistance(uvec4 corners, vec3 f, vec3 beyond, float cell) {
  vec2 a = unpackHalf2x16(corners.x);
  vec2 b = unpackHalf2x16(corners.y);
  vec2 c = unpackHalf2x16(corners.z);
  vec2 d = unpackHalf2x16(corners.w);
  vec4 along = vec4(a.y - a.x, b.y - b.x, c.y - c.x, d.y - d.x);
  vec4 x = vec4(a.x, b.x, c.x, d.x) + f.x * along;
  vec2 y = mix(x.xz, x.yw, f.y);
  vec2 slopes = mix(along.xz, along.yw, f.y);
  float distance = mix(y.x, y.y, f.z);
  vec3 gradient = vec3(mix(slopes.x, slopes.y, f.z), mix(x.y - x.x, x.w - x.z, f.z), y.y - y.x);
  float steepness = length(gradient);
  vec3 normal = steepness > 0.0 ? gradient / steepness : vec3(0, 1, 0);
  float within = max(distance, 0.0);
  float away = dot(beyond, beyond);
  if (away > 0.0) {
    vec3 way = beyond + within * normal;
    float wayLength = length(way);
    normal = wayLength > 0.0 ? way / wayLength : normal;
    distance = sqrt(away + within * within);
  }
  return Surface(distance * cell, normal);
}

#endif
