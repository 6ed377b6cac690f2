// Implements groom/usd/usd_file.h.
#include "ringlet/groom/usd/usd_file.h"

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "ringlet/base/quoted.h"
#include "ringlet/base/text_of.h"
#include "ringlet/groom/usd/usd_groom.h"
#include "ringlet/groom/usd/usda_file.h"
#include "ringlet/groom/usd/usdc_file.h"
#include "ringlet/groom/usd/usdz_file.h"

namespace ringlet {
Result<UsdLayer> readUsdLayer(std::span<const std::byte> bytes, const std::string& name, UsdContent content) {
  if (isUsdz(bytes)) {
    const auto first = firstOfUsdz(bytes, name);
    if (!first) return first.error();
    bytes = *first;
  }
  if (!isUsda(textOf(bytes)) && !isUsdc(bytes)) {
    return Error{fmt::format("{}: at byte 0: found {}; expected '#usda 1.0' or 'PXR-USDC'", name,
                             quoted(textOf(bytes.first(std::min<std::size_t>(bytes.size(), 10)))))};
  }
  auto layer =
      isUsdc(bytes) ? readUsdc(bytes, name, {.content = content}) : readUsda(textOf(bytes), name, content);
  if (layer) layer->byteCount = bytes.size();
  return layer;
}

Result<LoadedGroom> readUsd(std::span<const std::byte> bytes, const std::filesystem::path& path,
                            const GroomReading& reading) {
  const std::string name = path.string();
  const auto layer =
      readUsdLayer(bytes, name, reading.keepsPrims ? UsdContent::strandsAndValues : UsdContent::strands);
  if (!layer) return layer.error();
  return groomOfUsd(*layer, reading, name);
}

}  // namespace ringlet
