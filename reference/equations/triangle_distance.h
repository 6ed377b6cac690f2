// Distance of a place from a triangle: to its plane where the place is over its inside, else to an edge.
// Mirrors shaders/equations/triangle_distance.glsl.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>

#include "reference/fields.h"

namespace ringlet::reference {

template <class Real>
Real segmentDistance(const Vector3<Real>& p, const Vector3<Real>& a, const Vector3<Real>& b) {
  const Vector3<Real> way = b - a;
  const Real square = way.squaredNorm();
  const Real share = square > 0 ? std::clamp((p - a).dot(way) / square, Real(0), Real(1)) : Real(0);
  return (p - a - share * way).norm();
}

template <class Real>
Real triangleDistance(const Vector3<Real>& p, const Vector3<Real>& a, const Vector3<Real>& b,
                      const Vector3<Real>& c) {
  const Real toEdge =
      std::min({segmentDistance(p, a, b), segmentDistance(p, b, c), segmentDistance(p, c, a)});
  const Vector3<Real> normal = (b - a).cross(c - a);
  const Real area = normal.norm();
  const auto isLeftOf = [&](const Vector3<Real>& from, const Vector3<Real>& to) {
    return (to - from).cross(p - from).dot(normal) >= 0;
  };
  if (!(area > 0) || !isLeftOf(a, b) || !isLeftOf(b, c) || !isLeftOf(c, a)) return toEdge;
  return std::min(toEdge, std::abs((p - a).dot(normal)) / area);
}

/// Shares of the corners in the triangle's nearest place, of sum 1.
template <class Real>
Vector3<Real> nearestShares(const Vector3<Real>& p, const Vector3<Real>& a, const Vector3<Real>& b,
                            const Vector3<Real>& c) {
  const Vector3<Real> ab = b - a, ac = c - a, fromA = p - a;
  Vector3<Real> best = Vector3<Real>::UnitX();
  Real least = fromA.squaredNorm();
  const auto consider = [&](const Vector3<Real>& shares) {
    const Real square = (fromA - shares[1] * ab - shares[2] * ac).squaredNorm();
    if (square < least) least = square, best = shares;
  };
  const auto onLine = [&](const Vector3<Real>& from, const Vector3<Real>& line) {
    const Real square = line.squaredNorm();
    return square > Real(0) ? std::clamp((p - from).dot(line) / square, Real(0), Real(1)) : Real(0);
  };
  const Real onAb = onLine(a, ab), onAc = onLine(a, ac), onBc = onLine(b, Vector3<Real>(c - b));
  consider({1 - onAb, onAb, 0});
  consider({1 - onAc, 0, onAc});
  consider({0, 1 - onBc, onBc});
  const Real bb = ab.squaredNorm(), cc = ac.squaredNorm(), bc = ab.dot(ac);
  const Real ofB = ab.dot(fromA), ofC = ac.dot(fromA), area = bb * cc - bc * bc;
  const Real v = (cc * ofB - bc * ofC) / area, w = (bb * ofC - bc * ofB) / area;
  if (v >= 0 && w >= 0 && v + w <= 1) consider({1 - v - w, v, w});
  return best;
}

/// How far two straight lines, from p to q and from a to b, come from each other (Ericson, "Real-Time
/// Collision Detection", 2005, section 5.1.9).
template <class Real>
Real linesDistance(const Vector3<Real>& p, const Vector3<Real>& q, const Vector3<Real>& a,
                   const Vector3<Real>& b) {
  constexpr Real kLeast = Real(1e-30);  // in place of the square of a length 0
  const Vector3<Real> pq = q - p, ab = b - a, fromA = p - a;
  const Real pp = pq.squaredNorm(), aa = ab.squaredNorm(), pa = pq.dot(ab);
  const Real ofP = pq.dot(fromA), ofA = ab.dot(fromA), across = pp * aa - pa * pa;
  const Real first = std::clamp((pa * ofA - ofP * aa) / std::max(across, kLeast), Real(0), Real(1));
  const Real onA = std::clamp((pa * first + ofA) / std::max(aa, kLeast), Real(0), Real(1));
  const Real onP = std::clamp((pa * onA - ofP) / std::max(pp, kLeast), Real(0), Real(1));
  return (fromA + onP * pq - onA * ab).norm();
}

/// Where a straight line from p to q goes through a triangle, as a share of the line; 2 where it does not.
template <class Real>
Real crossingShare(const Vector3<Real>& p, const Vector3<Real>& q, const Vector3<Real>& a,
                   const Vector3<Real>& b, const Vector3<Real>& c) {
  const Vector3<Real> ab = b - a, ac = c - a, normal = ab.cross(ac);
  const Real before = normal.dot(p - a), after = normal.dot(q - a);
  if (!(before * after < 0)) return Real(2);
  const Real at = before / (before - after), area = normal.squaredNorm();
  const Vector3<Real> fromA = p + at * (q - p) - a;
  const Real v = fromA.cross(ac).dot(normal), w = ab.cross(fromA).dot(normal);
  return v >= 0 && w >= 0 && v + w <= area ? at : Real(2);
}

/// How far a straight line from p to q comes from a triangle; 0 where it goes through. Nearly parallel lines
/// cost digits: it is too large by at most some thousandths of the line's length.
template <class Real>
Real lineTriangleDistance(const Vector3<Real>& p, const Vector3<Real>& q, const Vector3<Real>& a,
                          const Vector3<Real>& b, const Vector3<Real>& c) {
  const auto toPlace = [&](const Vector3<Real>& place) {
    const Vector3<Real> shares = nearestShares<Real>(place, a, b, c);
    return (place - shares[0] * a - shares[1] * b - shares[2] * c).norm();
  };
  if (crossingShare<Real>(p, q, a, b, c) <= Real(1)) return Real(0);
  return std::min({toPlace(p), toPlace(q), linesDistance<Real>(p, q, a, b), linesDistance<Real>(p, q, b, c),
                   linesDistance<Real>(p, q, c, a)});
}

}  // namespace ringlet::reference
