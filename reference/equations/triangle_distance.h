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

}  // namespace ringlet::reference
