// Implements groom/usd/usd_file.h.
#include "ringlet/groom/usd/usd_file.h"

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "ringlet/base/quoted.h"
#include "ringlet/groom/usd/usd_groom.h"
#include "ringlet/groom/usd/usda_file.h"
#include "ringlet/groom/usd/usdc_file.h"
#include "ringlet/groom/usd/usdz_file.h"

namespace ringlet {
namespace {

std::string_view textOf(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

Result<LoadedGroom> readUsd(std::span<const std::byte> bytes, const std::filesystem::path& path,
                            const GroomReading& reading) {
  const std::string name = path.string();
  if (isUsdz(bytes)) {
    const auto first = firstOfUsdz(bytes, name);
    if (!first) return first.error();
    bytes = *first;
  }
  if (!isUsda(textOf(bytes)) && !isUsdc(bytes)) {
    return Error{fmt::format("{}: at byte 0: found {}; expected '#usda 1.0' or 'PXR-USDC'", name,
                             quoted(textOf(bytes.first(std::min<std::size_t>(bytes.size(), 10)))))};
  }
  auto layer = isUsdc(bytes) ? readUsdc(bytes, name, {.keepsValues = reading.keepsPrims})
                             : readUsda(textOf(bytes), name, reading.keepsPrims);
  if (!layer) return layer.error();
  layer->byteCount = bytes.size();
  return groomOfUsd(*layer, reading, name);
}

}  // namespace ringlet
