// Implements motion/usd_transform_stack.h.
#include "ringlet/motion/usd_transform_stack.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "ringlet/groom/usd/usd_transform.h"
#include "ringlet/groom/usd/usd_value_at.h"

namespace ringlet {

Result<UsdTransformStack> UsdTransformStack::of(const UsdPrims& prims, std::uint32_t prim) {
  UsdTransformStack stack(prims, prim);
  for (std::uint32_t p = prim; p != kNoUsdPrim; p = prims[p].parent) {
    UsdPrim ops{.name = prims[p].name, .type = prims[p].type, .composedBy = {}, .attributes = {}};
    for (const UsdAttribute& attribute : prims[p].attributes)
      if (attribute.name.starts_with("xformOp")) ops.attributes.push_back(attribute);
    const auto placement = usdPlacementOf(ops);
    if (!placement) return prims.wrong(p, placement.error().message);
    stack.transforms_.push_back(std::move(ops));
    if (placement->isOfWorld) break;
  }
  return stack;
}

Result<UsdTransform> UsdTransformStack::transformAt(double time) const {
  UsdTransform all;
  for (const UsdPrim& ops : transforms_) {
    UsdPrim now{.name = ops.name, .type = ops.type, .composedBy = {}, .attributes = {}};
    for (const UsdAttribute& op : ops.attributes)
      now.attributes.push_back({.name = op.name,
                                .value = op.samples.empty() ? op.value : usdValueAt(op.samples, time),
                                .drivenBy = op.drivenBy});
    const auto placement = usdPlacementOf(now);
    if (!placement)
      return prims_.wrong(prim_, fmt::format("at time {}: {}", time, placement.error().message));
    all = all.then(placement->transform);
  }
  return all;
}

Result<PlacementSamples> UsdTransformStack::placements(const Affine& world) const {
  const auto rate = prims_.timeCodesPerSecond();
  if (!rate) return rate.error();
  std::set<double> times;
  for (const UsdPrim& ops : transforms_)
    for (const UsdAttribute& op : ops.attributes)
      for (const UsdSample& sample : op.samples) times.insert(sample.time);
  if (times.empty()) times.insert(0);
  PlacementSamples placed{{}, {}};
  for (const double time : times) {
    const auto transform = transformAt(time);
    if (!transform) return transform.error();
    placed.seconds.push_back(time / *rate);
    const auto& [x, y, z] = transform->rows;
    placed.placements.push_back(world * Affine{x, y, z, transform->move});
  }
  return placed;
}

}  // namespace ringlet
