// Affine: a linear map and a shift, as the nodes of a glTF file place each other; and the rotation nearest to
// one.
#pragma once

#include <optional>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// p -> x p.x + y p.y + z p.z + position.
struct Affine {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  // where the axes go: the columns of the matrix
  Vec3d position;

  Vec3d turned(Vec3d direction) const { return x * direction.x + y * direction.y + z * direction.z; }
  Vec3d operator()(Vec3d p) const { return turned(p) + position; }
  /// Applies `inner` first.
  Affine operator*(const Affine& inner) const {
    return {turned(inner.x), turned(inner.y), turned(inner.z), (*this)(inner.position)};
  }
  bool isFinite() const;
};

/// Scaled, then rotated by a unit quaternion, then shifted.
Affine affineOf(Vec3d position, Quatd rotation, Vec3d scale);

/// The unit quaternion of an orthonormal, right-handed frame given by its axes.
Quatd rotationOf(Vec3d x, Vec3d y, Vec3d z);

/// The rotation nearest to the linear part (of its polar decomposition); where that mirrors, of what it is
/// with its first axis mirrored back. Nothing where it flattens space or is not finite.
std::optional<Quatd> nearestRotation(const Affine& map);

}  // namespace ringlet
