// The vector from the nearest place of a triangle to another place: the nearest of its three edges and, where the
// place is over its inside, its plane (Ericson, "Real-Time Collision Detection", 2005, section 5.1). Each candidate
// is a place of the triangle, so a needle, whose inside is all rounding, is still met at an edge. Without branches,
// which lavapipe does not have. Mirrored by reference/equations/triangle_distance.h.
#ifndef RINGLET_TRIANGLE_DISTANCE
#define RINGLET_TRIANGLE_DISTANCE

const float kLeastSquare = 1e-30;  // in place of the square of a length 0

vec3 wayFromLine(vec3 fromA, vec3 ab) {
  return fromA - clamp(dot(fromA, ab) / max(dot(ab, ab), kLeastSquare), 0.0, 1.0) * ab;
}

vec3 shorterOf(vec3 a, vec3 b) { return dot(b, b) < dot(a, a) ? b : a; }

/// p and the triangle's corners in any unit; the result in the same.
vec3 wayFromTriangle(vec3 p, vec3 a, vec3 b, vec3 c) {
  vec3 ab = b - a;
  vec3 ac = c - a;
  vec3 fromA = p - a;
  vec3 way = shorterOf(shorterOf(wayFromLine(fromA, ab), wayFromLine(fromA, ac)), wayFromLine(p - b, c - b));
  float bb = dot(ab, ab);
  float cc = dot(ac, ac);
  float bc = dot(ab, ac);
  float ofB = dot(ab, fromA);
  float ofC = dot(ac, fromA);
  float area = max(bb * cc - bc * bc, kLeastSquare);
  float v = (cc * ofB - bc * ofC) / area;
  float w = (bb * ofC - bc * ofB) / area;
  bool isOver = v >= 0.0 && w >= 0.0 && v + w <= 1.0;
  vec3 shorter = shorterOf(way, fromA - v * ab - w * ac);
  return isOver ? shorter : way;
}

#endif
