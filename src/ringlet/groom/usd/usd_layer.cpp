// Implements groom/usd/usd_layer.h.
#include "ringlet/groom/usd/usd_layer.h"

#include "ringlet/base/quoted.h"

namespace ringlet {

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
