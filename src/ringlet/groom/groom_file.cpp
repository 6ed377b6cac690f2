// Implements groom/groom_file.h.
#include "ringlet/groom/groom_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ringlet/base/assert.h"
#include "ringlet/base/file_ending.h"
#include "ringlet/base/whole_file.h"
#include "ringlet/groom/alembic/abc_groom.h"
#include "ringlet/groom/hair_file.h"
#include "ringlet/groom/obj_file.h"
#include "ringlet/groom/ply_file.h"
#include "ringlet/groom/root_ends.h"
#include "ringlet/groom/strand_list_file.h"
#include "ringlet/groom/tfx_file.h"
#include "ringlet/groom/usd/usd_file.h"

namespace ringlet {
namespace {

enum class Format { hair, obj, tfx, usd, abc, ply, data, bin };

std::optional<Format> formatOf(const std::filesystem::path& path) {
  const std::string extension = endingOf(path);
  if (extension == ".hair") return Format::hair;
  if (extension == ".obj") return Format::obj;
  if (extension == ".tfx") return Format::tfx;
  if (extension == ".usda" || extension == ".usdc" || extension == ".usd" || extension == ".usdz")
    return Format::usd;
  if (extension == ".abc") return Format::abc;
  if (extension == ".ply") return Format::ply;
  if (extension == ".data") return Format::data;
  if (extension == ".bin") return Format::bin;
  return std::nullopt;
}

Error unknownExtension(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  return {fmt::format("{}: cannot read a groom: {}; supported are {}", path.string(),
                      extension.empty() ? std::string("the name has no extension")
                                        : fmt::format("the extension '{}' is unknown", extension),
                      kGroomEndings)};
}

Result<LoadedGroom> readFormat(Format format, std::span<const std::byte> bytes,
                               const std::filesystem::path& path, const GroomReading& reading) {
  switch (format) {
    case Format::hair:
      return readHair(bytes, path, reading);
    case Format::obj:
      return readObj(bytes, path, reading);
    case Format::tfx:
      return readTfx(bytes, path);
    case Format::usd:
      return readUsd(bytes, path, reading);
    case Format::abc:
      return readAbcGroom(bytes, path, reading);
    case Format::ply:
      return readPly(bytes, path, reading);
    case Format::data:
      return readStrandData(bytes, path);
    case Format::bin:
      return readStrandBin(bytes, path);
  }
  RINGLET_ASSERT(false, "a format without a reader");
}

// What is said of points would now be of others.
void dropPointValues(LoadedGroom& loaded) {
  for (GroomPrim& prim : loaded.prims) {
    prim.isWhole = false;
    std::erase_if(prim.values, [](const GroomValue& value) {
      const bool isOfPoints = value.interpolation == "vertex" || value.interpolation == "varying";
      return isOfPoints || (value.interpolation.empty() && value.name == "widths");
    });
  }
}

void applyRootEnd(RootEnd end, const std::filesystem::path& path, LoadedGroom& loaded) {
  if (end == RootEnd::first) return;
  std::vector<bool> which(loaded.groom.strandCount(), true);
  if (end == RootEnd::head) {
    RootEnds found = findRootEnds(loaded.groom);
    if (!found.head) {
      loaded.warnings.push_back(fmt::format(
          "{}: its strands have no ends on a ball, by which a head could tell roots from tips; all begin at "
          "the first point",
          path.string()));
    }
    which = std::move(found.isReversed);
  }
  const auto turned = std::ranges::count(which, true);
  if (turned == 0) return;
  turnRound(which, loaded.groom);
  dropPointValues(loaded);
  loaded.warnings.push_back(fmt::format("{}: {} of {} strands are turned round, to begin at their last point",
                                        path.string(), turned, which.size()));
}

}  // namespace

bool isGroomFile(const std::filesystem::path& path) { return formatOf(path).has_value(); }

Result<LoadedGroom> readGroom(const std::filesystem::path& path, const GroomReading& reading) {
  std::error_code code;  // what is not there is no folder
  if (std::filesystem::is_directory(path, code)) {
    return Error{
        fmt::format("{}: is a folder; expected the file of a groom, {}", path.string(), kGroomEndings),
        Fault::input};
  }
  const std::optional<Format> format = formatOf(path);
  if (!format) return unknownExtension(path);
  try {
    Result<std::vector<std::byte>> bytes = readWholeFile(path);
    if (!bytes) return bytes.error();
    auto loaded = readFormat(*format, *bytes, path, reading);
    if (loaded) applyRootEnd(reading.rootEnd, path, *loaded);
    return loaded;
  } catch (const std::bad_alloc&) {
    return Error{fmt::format("{}: reading it needs more memory than there is", path.string())};
  }
}

}  // namespace ringlet
