// UsdTransform: an affine map as USD has it, which multiplies rows: p' = p M.
#pragma once

#include <array>
#include <cmath>

#include "ringlet/base/vec3.h"

namespace ringlet {

struct UsdTransform {
  std::array<Vec3d, 3> rows{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
  Vec3d move{};

  Vec3d operator()(Vec3d p) const { return turned(p) + move; }
  Vec3d turned(Vec3d p) const { return rows[0] * p.x + rows[1] * p.y + rows[2] * p.z; }
  /// This first, then the other.
  UsdTransform then(const UsdTransform& next) const {
    return {{next.turned(rows[0]), next.turned(rows[1]), next.turned(rows[2])}, next(move)};
  }
  double determinant() const { return dot(rows[0], cross(rows[1], rows[2])); }
  /// What brings points back. The determinant is not 0.
  UsdTransform inverse() const {
    const double scale = 1 / determinant();
    // Columns of the inverse are cross products of rows; their rows are wanted.
    const Vec3d x = cross(rows[1], rows[2]) * scale, y = cross(rows[2], rows[0]) * scale,
                z = cross(rows[0], rows[1]) * scale;
    UsdTransform back{{Vec3d{x.x, y.x, z.x}, Vec3d{x.y, y.y, z.y}, Vec3d{x.z, y.z, z.z}}, {}};
    back.move = -back.turned(move);
    return back;
  }
  /// Of lengths, in the mean of all directions.
  double scale() const { return std::cbrt(std::abs(determinant())); }
  bool operator==(const UsdTransform&) const = default;
};

/// A turn, and then a move.
inline UsdTransform rigidTransform(Quatd rotation, Vec3d move) {
  return {
      {rotate(rotation, Vec3d{1, 0, 0}), rotate(rotation, Vec3d{0, 1, 0}), rotate(rotation, Vec3d{0, 0, 1})},
      move};
}

}  // namespace ringlet
