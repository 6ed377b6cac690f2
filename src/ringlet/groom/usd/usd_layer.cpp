// Implements groom/usd/usd_layer.h.
#include "ringlet/groom/usd/usd_layer.h"

#include <fmt/format.h>

#include <algorithm>

#include "ringlet/base/quoted.h"

namespace ringlet {

const UsdAttribute* usdAttributeOf(const UsdPrim& prim, std::string_view name) {
  const auto found = std::ranges::find(prim.attributes, name, &UsdAttribute::name);
  return found == prim.attributes.end() ? nullptr : &*found;
}

std::string_view usdTokenOf(const UsdPrim& prim, std::string_view name, std::string_view otherwise) {
  const UsdAttribute* attribute = usdAttributeOf(prim, name);
  return attribute && attribute->value.texts.size() == 1 ? attribute->value.texts.front() : otherwise;
}

Result<double> usdTimeCodesPerSecond(const UsdLayer& layer, const std::string& name) {
  constexpr double kUsual = 24, kMost = 1e6;
  const double rate = layer.timeCodesPerSecond.value_or(kUsual);
  if (rate > 0 && rate <= kMost) return rate;
  return Error{fmt::format("{}: found {} time codes per second; expected more than 0", name, rate)};
}

std::string usdPathOf(const UsdLayer& layer, std::uint32_t prim) {
  constexpr std::size_t kMostLevels = 16;  // enough to find it, short enough for a line
  std::string path;
  for (std::size_t level = 0; prim != kNoUsdPrim; prim = layer.prims[prim].parent) {
    if (++level > kMostLevels) return "..." + path;
    const std::string name = quoted(layer.prims[prim].name);
    path = "/" + name.substr(1, name.size() - 2) + path;
  }
  return path;
}

}  // namespace ringlet
