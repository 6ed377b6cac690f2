// Implements motion/usd_clip_files.h.
#include "ringlet/motion/usd_clip_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "ringlet/base/text_of.h"
#include "ringlet/base/whole_file.h"
#include "ringlet/groom/usd/usd_file.h"
#include "ringlet/groom/usd/usda_file.h"
#include "ringlet/groom/usd/usdc_file.h"
#include "ringlet/groom/usd/usdz_file.h"
#include "ringlet/motion/name_below.h"
#include "ringlet/motion/usd_clip_sets.h"

namespace ringlet {
namespace {

namespace fs = std::filesystem;

// Without points, of which a file that has no clips may have many.
Result<UsdLayer> layerWithoutSamples(std::span<const std::byte> bytes, const std::string& name) {
  if (isUsdc(bytes)) return readUsdc(bytes, name, {.keepsPlaces = true, .content = UsdContent::meshes});
  if (textOf(bytes).find("clips") == std::string_view::npos) return UsdLayer{};
  return readUsdLayer(bytes, name, UsdContent::meshes);
}

}  // namespace

Status UsdClipFolder::check(const std::string& name) const {
  const std::string why = whyNotBelow(name, folder_, "USD");
  if (why.empty()) return {};
  return Error{fmt::format(
      "the clip {} {}; clips are read from the folder of the USD file and below it, and from nowhere else",
      name, why)};
}

std::string UsdClipFolder::pathOf(const std::string& name) const {
  return (folder_ / fs::path(name).lexically_normal()).string();
}

bool UsdClipFolder::has(const std::string& name) const {
  std::error_code code;
  return fs::exists(pathOf(name), code);
}

Result<std::vector<std::byte>> UsdClipFolder::read(const std::string& name) const {
  return readWholeFile(pathOf(name));
}

std::vector<fs::path> usdClipFilesOf(const fs::path& path) {
  const auto bytes = readWholeFile(path);
  if (!bytes || isUsdz(*bytes)) return {};
  const std::string name = path.string();
  const auto layer = layerWithoutSamples(*bytes, name);
  if (!layer) return {};
  const UsdPrims prims(*layer, name);
  const UsdClipFolder folder(path.parent_path());
  std::vector<fs::path> paths;
  for (std::uint32_t prim = 0; prim < layer->prims.size(); ++prim) {
    const auto schedules = clipSchedulesOf(prims, prim, folder);
    if (!schedules) continue;
    for (const UsdClipSchedule& schedule : *schedules)
      for (const std::string& file : schedule.files) paths.emplace_back(folder.pathOf(file));
  }
  std::ranges::sort(paths);
  paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
  return paths;
}

}  // namespace ringlet
