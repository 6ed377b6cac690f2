// UsdTransformStack: where a USD prim stands over time, by its own transforms and those of the prims above
// it.
#pragma once

#include <cstdint>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/usd/usd_matrix.h"
#include "ringlet/motion/affine.h"
#include "ringlet/motion/sampled_mesh.h"
#include "ringlet/motion/usd_prims.h"

namespace ringlet {

class UsdTransformStack {
 public:
  /// `prims` must live as long. Errors are those of usdPlacementOf().
  static Result<UsdTransformStack> of(const UsdPrims& prims, std::uint32_t prim);

  /// Placed by `world` at every time at which one of the transforms has a sample; once, where none has.
  Result<PlacementSamples> placements(const Affine& world) const;

 private:
  explicit UsdTransformStack(const UsdPrims& prims, std::uint32_t prim) : prims_(prims), prim_(prim) {}
  Result<UsdTransform> transformAt(double time) const;

  const UsdPrims& prims_;
  std::uint32_t prim_;
  std::vector<UsdPrim> transforms_;  // with nothing but their ops, the prim itself first
};

}  // namespace ringlet
