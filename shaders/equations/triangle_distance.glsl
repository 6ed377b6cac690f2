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

/// Shares of the corners in the triangle's nearest place, of sum 1.
vec3 nearestShares(vec3 p, vec3 a, vec3 b, vec3 c) {
  vec3 ab = b - a;
  vec3 ac = c - a;
  vec3 bc = c - b;
  vec3 fromA = p - a;
  float bb = dot(ab, ab);
  float cc = dot(ac, ac);
  float mixed = dot(ab, ac);
  float ofB = dot(ab, fromA);
  float ofC = dot(ac, fromA);
  float onAb = clamp(ofB / max(bb, kLeastSquare), 0.0, 1.0);
  float onAc = clamp(ofC / max(cc, kLeastSquare), 0.0, 1.0);
  float onBc = clamp(dot(p - b, bc) / max(dot(bc, bc), kLeastSquare), 0.0, 1.0);
  float area = max(bb * cc - mixed * mixed, kLeastSquare);
  vec2 over = vec2(cc * ofB - mixed * ofC, bb * ofC - mixed * ofB) / area;
  vec2 best = vec2(0);
  float least = dot(fromA, fromA);
  for (int candidate = 0; candidate < 4; ++candidate) {
    vec2 shares = candidate == 0   ? vec2(onAb, 0.0)
                  : candidate == 1 ? vec2(0.0, onAc)
                  : candidate == 2 ? vec2(1.0 - onBc, onBc)
                                   : over;
    vec3 way = fromA - shares.x * ab - shares.y * ac;
    bool isOnIt = shares.x >= 0.0 && shares.y >= 0.0 && (candidate < 3 || shares.x + shares.y <= 1.0);
    bool isNearer = isOnIt && dot(way, way) < least;
    best = isNearer ? shares : best;
    least = isNearer ? dot(way, way) : least;
  }
  return vec3(1.0 - best.x - best.y, best);
}

/// How far two straight lines, from p to q and from a to b, come from each other (Ericson, "Real-Time Collision
/// Detection", 2005, section 5.1.9).
float linesDistance(vec3 p, vec3 q, vec3 a, vec3 b) {
  vec3 pq = q - p;
  vec3 ab = b - a;
  vec3 fromA = p - a;
  float pp = dot(pq, pq);
  float aa = dot(ab, ab);
  float pa = dot(pq, ab);
  float ofP = dot(pq, fromA);
  float ofA = dot(ab, fromA);
  float first = clamp((pa * ofA - ofP * aa) / max(pp * aa - pa * pa, kLeastSquare), 0.0, 1.0);
  float onA = clamp((pa * first + ofA) / max(aa, kLeastSquare), 0.0, 1.0);
  float onP = clamp((pa * onA - ofP) / max(pp, kLeastSquare), 0.0, 1.0);
  return length(fromA + onP * pq - onA * ab);
}

/// Where a straight line from p to q goes through a triangle, as a share of the line; 2 where it does not.
float crossingShare(vec3 p, vec3 q, vec3 a, vec3 b, vec3 c) {
  vec3 normal = cross(b - a, c - a);
  float before = dot(normal, p - a);
  float after = dot(normal, q - a);
  bool isAcross = before * after < 0.0;
  float at = isAcross ? before / (before - after) : 0.0;
  vec3 fromA = p + at * (q - p) - a;
  float v = dot(cross(fromA, c - a), normal);
  float w = dot(cross(b - a, fromA), normal);
  return isAcross && v >= 0.0 && w >= 0.0 && v + w <= dot(normal, normal) ? at : 2.0;
}

/// How far a straight line from p to q comes from a triangle; 0 where it goes through. Nearly parallel lines cost
/// digits: it is too large by at most some thousandths of the line's length.
float lineTriangleDistance(vec3 p, vec3 q, vec3 a, vec3 b, vec3 c) {
  float toEdges = min(linesDistance(p, q, a, b), min(linesDistance(p, q, b, c), linesDistance(p, q, c, a)));
  float toEnds = min(length(wayFromTriangle(p, a, b, c)), length(wayFromTriangle(q, a, b, c)));
  return crossingShare(p, q, a, b, c) <= 1.0 ? 0.0 : min(toEdges, toEnds);
}

#endif
