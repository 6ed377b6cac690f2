// UsdTransform: how a USD prim places what is below it, from its xformOps.
//
//   USD multiplies rows: p' = p M. Of an order [a, b, c] c comes first: p' = p C B A.
#pragma once

#include <array>
#include <string>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/usd_layer.h"

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
  bool operator==(const UsdTransform&) const = default;
};

/// What a prim's xformOpOrder makes of its xformOps.
struct UsdPlacement {
  UsdTransform transform;
  bool isOfWorld = false;  // !resetXformStack!: prims above it do not count
};

/// Rotations in degrees, about the axes in the order of their name's letters. Errors, which begin with the
/// op's name: an op that is unknown or not there, another count of numbers, numbers that are not finite, an
/// inverse that does not exist, a matrix that is no affine one, a value that a connection or spline gives.
Result<UsdPlacement> usdPlacementOf(const UsdPrim& prim);

}  // namespace ringlet
