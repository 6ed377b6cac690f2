// Where a column along x goes through a triangle whose corners lie, across it, on a lattice. A column through
// a corner or an edge is taken to be shifted by an infinitely small step along +y and a far smaller one along
// +z. Mirrors shaders/equations/column_crossing.glsl.
#pragma once

#include <array>
#include <cstdint>

namespace ringlet::reference {

using LatticePoint = std::array<std::int64_t, 2>;  // y, z

/// turns: 1 where the column enters what the triangle bounds, -1 where it leaves it, 0 where it passes by.
template <class Real>
struct ColumnCrossing {
  int turns = 0;
  Real x = 0;
};

/// On which side of the line from a to b the shifted column is: 1 left, -1 right.
inline int sideOf(const LatticePoint& a, const LatticePoint& b, const LatticePoint& q) {
  const std::int64_t dy = b[0] - a[0], dz = b[1] - a[1];
  const std::int64_t area = dy * (q[1] - a[1]) - dz * (q[0] - a[0]);
  // A shift along +y changes the area by -dz, one along +z by dy.
  for (const std::int64_t sign : {area, -dz, dy})
    if (sign != 0) return sign > 0 ? 1 : -1;
  return 0;
}

/// corners: in the order of the triangle, counter-clockwise seen from outside; x: theirs.
template <class Real>
ColumnCrossing<Real> columnCrossing(const std::array<LatticePoint, 3>& corners, const std::array<Real, 3>& x,
                                    const LatticePoint& q) {
  const auto& [a, b, c] = corners;
  const int side = sideOf(a, b, q);
  if (side == 0 || side != sideOf(b, c, q) || side != sideOf(c, a, q)) return {};
  // The plane through the corners, at the column.
  const Real aboutY = Real(b[0] - a[0]), aboutZ = Real(b[1] - a[1]);
  const Real farY = Real(c[0] - a[0]), farZ = Real(c[1] - a[1]);
  const Real area = aboutY * farZ - aboutZ * farY;
  const Real y = Real(q[0] - a[0]), z = Real(q[1] - a[1]);
  const Real alongB = (y * farZ - z * farY) / area, alongC = (aboutY * z - aboutZ * y) / area;
  // Seen along +x a triangle that is entered turns clockwise.
  return {side > 0 ? -1 : 1, x[0] + alongB * (x[1] - x[0]) + alongC * (x[2] - x[0])};
}

}  // namespace ringlet::reference
