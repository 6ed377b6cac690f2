// UsdPlacement: how a USD prim places what is below it, from its xformOps.
//
//   Of an order [a, b, c] c comes first: p' = p C B A.
#pragma once

#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/usd/usd_layer.h"
#include "ringlet/groom/usd/usd_matrix.h"

namespace ringlet {

/// What a prim's xformOpOrder makes of its xformOps.
struct UsdPlacement {
  UsdTransform transform;
  bool isOfWorld = false;                // !resetXformStack!: prims above it do not count
  std::vector<std::string> valueless{};  // ops of the order that have no value, in quotes; USD skips them
};

/// Rotations in degrees, about the axes in the order of their name's letters. Errors, which begin with the
/// op's name: an op that is unknown, another count of numbers, numbers that are not finite, an
/// inverse that does not exist, a matrix that is no affine one, a value that a connection or spline gives.
Result<UsdPlacement> usdPlacementOf(const UsdPrim& prim);

}  // namespace ringlet
