// How far a place is from a body's surface, and the way out, in the body's own frame: closed forms, and the
// trilinear interpolation of a distance grid. Mirrors shaders/equations/body_distance.glsl.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "reference/fields.h"
#include "ringlet/scene/body.h"

namespace ringlet::reference {

/// Negative inside; the way out has length 1.
template <class Real>
struct Surface {
  Real distance = 0;  // [m]
  Vector3<Real> normal = Vector3<Real>::UnitY();
};

/// Where there is no way out (the middle of a sphere), it is X.
template <class Real>
Surface<Real> distanceToPoint(const Vector3<Real>& offset) {
  return {offset.norm(), directionOr<Real>(offset, Vector3<Real>::UnitX())};
}

template <class Real>
Surface<Real> boxDistance(const Vector3<Real>& halfExtents, const Vector3<Real>& y) {
  const Vector3<Real> beyond = y.cwiseAbs() - halfExtents;
  const Vector3<Real> side = y.unaryExpr([](Real x) { return x < 0 ? Real(-1) : Real(1); });
  const Vector3<Real> outside = beyond.cwiseMax(Real(0));
  if (outside.norm() > Real(0)) return {outside.norm(), side.cwiseProduct(outside.normalized())};
  Eigen::Index nearest = 0;
  const Real depth = beyond.maxCoeff(&nearest);
  return {depth, side[nearest] * Vector3<Real>::Unit(nearest)};
}

/// As the device holds it: half precision, in cells.
template <class Real>
Real gridCorner(const DistanceGrid& grid, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  const float inCells = grid.distances[grid.cornerIndex(x, y, z)] / static_cast<float>(grid.cell);
  return static_cast<Real>(static_cast<float>(Eigen::half(inCells)));
}

/// Beyond the grid: the surface lies within it, so a place a from the grid's nearest place c is at least
/// sqrt(a^2 + distance(c)^2) from it.
template <class Real>
Surface<Real> gridDistance(const DistanceGrid& grid, const Vector3<Real>& place) {
  const Real cell = static_cast<Real>(grid.cell);
  const Vector3<Real> counts(static_cast<Real>(grid.counts[0]), static_cast<Real>(grid.counts[1]),
                             static_cast<Real>(grid.counts[2]));
  const Vector3<Real> wanted = (place - toEigen<Real>(grid.origin)) / cell;
  const Vector3<Real> nearest = wanted.cwiseMax(Real(0)).cwiseMin(counts);
  const Vector3<Real> beyond = wanted - nearest;
  const Vector3<Real> base = nearest.array().floor().matrix().cwiseMin(counts - Vector3<Real>::Ones());
  const Vector3<Real> f = nearest - base;

  // The eight corners and their weights; slopes by differences, which are 0 where all corners are alike.
  Real corners[8];
  Vector3<Real> weights[8];
  for (int corner = 0; corner < 8; ++corner) {
    std::uint32_t at[3];
    for (int axis = 0; axis < 3; ++axis) {
      const int upper = corner >> axis & 1;
      at[axis] = static_cast<std::uint32_t>(base[axis]) + static_cast<std::uint32_t>(upper);
      weights[corner][axis] = upper ? f[axis] : 1 - f[axis];
    }
    corners[corner] = gridCorner<Real>(grid, at[0], at[1], at[2]);
  }
  Real distance = 0;
  Vector3<Real> gradient = Vector3<Real>::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3<Real>& weight = weights[corner];
    distance += corners[corner] * weight.prod();
    for (int axis = 0; axis < 3; ++axis)
      if ((corner >> axis & 1) == 0)
        gradient[axis] +=
            (corners[corner | 1 << axis] - corners[corner]) * weight[(axis + 1) % 3] * weight[(axis + 2) % 3];
  }
  Vector3<Real> normal = directionOr<Real>(gradient, Vector3<Real>::UnitY());
  if (beyond.norm() > Real(0)) {
    const Real within = std::max(distance, Real(0));
    normal = directionOr<Real>(beyond + within * normal, normal);
    distance = std::hypot(beyond.norm(), within);
  }
  return {distance * cell, normal};
}

/// y in the body's frame [m]. What hair keeps away beside (Body::thickness) is taken off.
template <class Real>
Surface<Real> bodyDistance(const Body& body, const Vector3<Real>& y) {
  Surface<Real> surface;
  switch (body.shape) {
    case BodyShape::sphere:
      surface = distanceToPoint<Real>(y);
      surface.distance -= static_cast<Real>(body.radius);
      break;
    case BodyShape::capsule: {
      const Real half = static_cast<Real>(body.length / 2);
      surface = distanceToPoint<Real>(y - Vector3<Real>(0, std::clamp(y.y(), -half, half), 0));
      surface.distance -= static_cast<Real>(body.radius);
      break;
    }
    case BodyShape::plane:
      surface = {y.y(), Vector3<Real>::UnitY()};
      break;
    case BodyShape::box:
      surface = boxDistance<Real>(toEigen<Real>(body.halfExtents), y);
      break;
    case BodyShape::grid:
      surface = gridDistance<Real>(*body.grid, y);
      break;
  }
  surface.distance -= static_cast<Real>(body.thickness);
  return surface;
}

}  // namespace ringlet::reference
