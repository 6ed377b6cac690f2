// The place of a triangle that is closest to another place: Ericson, "Real-Time Collision Detection", 2005,
// section 5.1.5.
//
//        \  C  /       which of the seven regions about the triangle the place is over says what is closest:
//         \ . /        a corner, an edge or the inside
//     AC   / \   BC
//      ___/___\___
//     A  / AB  \  B
#pragma once

#include <algorithm>
#include <array>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// How far along the line from a to b, from 0 to 1, it is closest to p; the two may be one.
inline double shareOnLine(Vec3d p, Vec3d a, Vec3d b) {
  const double squaredLength = dot(b - a, b - a);
  return squaredLength > 0 ? std::clamp(dot(p - a, b - a) / squaredLength, 0.0, 1.0) : 0;
}

/// Shares of the corners in the place of triangle abc closest to p, of sum 1; of a corner or an edge some are
/// 0. The triangle may be as thin as a line. Exact but for needles, whose height is below 1e-6 of their
/// length: there by that height at most.
inline std::array<double, 3> closestShares(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
  const Vec3d ab = b - a, ac = c - a;
  const Vec3d ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};

  const Vec3d bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};

  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};

  const Vec3d cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};

  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};

  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double onBc = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - onBc, onBc};
  }

  constexpr double kNeedle = 1e-12;  // the square of the sine at a
  // Four times the area's square. Of a needle it is all rounding; any of its edges is then as near as its
  // inside.
  const double squaredArea = va + vb + vc;
  if (squaredArea > kNeedle * dot(ab, ab) * dot(ac, ac))
    return {1 - vb / squaredArea - vc / squaredArea, vb / squaredArea, vc / squaredArea};
  const double onAb = shareOnLine(p, a, b), onBc = shareOnLine(p, b, c), onCa = shareOnLine(p, c, a);
  const auto squaredTo = [&](Vec3d from, Vec3d to, double share) {
    const Vec3d apart = p - (from + (to - from) * share);
    return dot(apart, apart);
  };
  const double toAb = squaredTo(a, b, onAb), toBc = squaredTo(b, c, onBc), toCa = squaredTo(c, a, onCa);
  if (toCa < std::min(toAb, toBc)) return {onCa, 0, 1 - onCa};
  if (toBc < toAb) return {0, 1 - onBc, onBc};
  return {1 - onAb, onAb, 0};
}

inline Vec3d closestOnTriangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
  const auto [ofA, ofB, ofC] = closestShares(p, a, b, c);
  return a * ofA + b * ofB + c * ofC;
}

}  // namespace ringlet
