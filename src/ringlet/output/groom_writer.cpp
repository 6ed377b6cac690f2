// Implements output/groom_writer.h: the table of formats.
#include "ringlet/output/groom_writer.h"

#include <fmt/format.h>

#include <algorithm>

#include "ringlet/base/file_ending.h"
#include "ringlet/base/whole_file.h"
#include "ringlet/groom/alembic/abc_out.h"
#include "ringlet/groom/groom_check.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/groom/hair_file.h"
#include "ringlet/groom/obj_file.h"
#include "ringlet/groom/ply_file.h"
#include "ringlet/output/alembic/abc_stage.h"
#include "ringlet/output/usd/usd_hair_stage.h"
#include "ringlet/output/usd/usd_text.h"
#include "ringlet/output/usd/usdc_head.h"

namespace ringlet {
namespace {

namespace fs = std::filesystem;

// What is made of a groom that can be written.
template <class Make>
Status writeMade(const fs::path& path, const Groom& groom, const Make& make) {
  if (Status checked = checkGroom(groom, groom.points, path); !checked) return checked;
  const auto made = make();
  return writeWholeFile(path, std::as_bytes(std::span(made)));
}

Status writeAbcGroom(const fs::path& path, const Groom& groom, const GroomWriting& writing) {
  return writeMade(path, groom, [&] { return abcFileOf(abcGroomOf(groom, writing)); });
}
Status writeUsdaGroom(const fs::path& path, const Groom& groom, const GroomWriting& writing) {
  return writeMade(path, groom, [&] { return usdTextOf(groomStageOf(groom, writing).stage); });
}
Status writeUsdcGroom(const fs::path& path, const Groom& groom, const GroomWriting& writing) {
  return writeMade(path, groom, [&] { return usdcHeadOf(groomStageOf(groom, writing).stage).bytes; });
}

constexpr WrittenGroomFormat kGroomFormats[] = {
    {".hair", false,
     [](const fs::path& path, const Groom& groom, const GroomWriting&) { return writeHair(path, groom); }},
    {".obj", false,
     [](const fs::path& path, const Groom& groom, const GroomWriting&) { return writeObj(path, groom); }},
    {".ply", false,
     [](const fs::path& path, const Groom& groom, const GroomWriting&) {
       return writePly(path, groom, groom.points);
     }},
    {".abc", true, writeAbcGroom},
    {".usda", true, writeUsdaGroom},
    {".usdc", true, writeUsdcGroom}};

}  // namespace

std::span<const WrittenGroomFormat> writtenGroomFormats() { return kGroomFormats; }

const WrittenGroomFormat* writtenGroomFormatOf(const fs::path& path) {
  const auto* found = std::ranges::find(kGroomFormats, endingOf(path), &WrittenGroomFormat::ending);
  return found == std::end(kGroomFormats) ? nullptr : found;
}

std::vector<std::string> writtenGroomEndings() {
  std::vector<std::string> endings;
  for (const WrittenGroomFormat& format : kGroomFormats) endings.emplace_back(format.ending);
  return endings;
}

std::string writtenGroomEndings(const char* last) {
  const std::vector<std::string> endings = writtenGroomEndings();
  std::string text = endings.front();
  for (std::size_t i = 1; i < endings.size(); ++i)
    text += (i + 1 < endings.size() ? ", " : fmt::format(" {} ", last)) + endings[i];
  return text;
}

Status writeGroom(const fs::path& path, const Groom& groom, const GroomWriting& writing) {
  if (const WrittenGroomFormat* format = writtenGroomFormatOf(path))
    return format->write(path, groom, writing);
  const std::string extension = path.extension().string();
  return Error{fmt::format("{}: cannot write a groom: {}; supported are {}", path.string(),
                           extension.empty()   ? std::string("the name has no extension")
                           : isGroomFile(path) ? fmt::format("{} is only read", extension)
                                               : fmt::format("the extension '{}' is unknown", extension),
                           writtenGroomEndings("and"))};
}

}  // namespace ringlet
