// Implements written_groom.h.
#include "program/cli/written_groom.h"

#include <fmt/format.h>

#include "ringlet/output/groom_writer.h"

namespace ringlet::program {

std::vector<std::string> lostIn(const std::filesystem::path& path, double unit, bool upIsZ) {
  std::vector<std::string> lost;
  const WrittenGroomFormat* format = writtenGroomFormatOf(path);
  if (format && format->isStating) return lost;
  if (unit != Groom{}.metresPerUnit) {
    lost.push_back(fmt::format(
        "{} does not hold its unit, {} m, and without an option counts as {} m; say --unit {} to every "
        "command that reads it, or unit = {} of [groom]",
        path.string(), unit, Groom{}.metresPerUnit, unit, unit));
  }
  if (upIsZ) {
    lost.push_back(fmt::format(
        "{} does not hold its up axis, Z, and without an option counts as Y up; say --up Z to every command "
        "that reads it, or up = \"Z\" of [groom]",
        path.string()));
  }
  return lost;
}

std::optional<UpAxis> upOf(const std::optional<std::string>& typed, const LoadedGroom& loaded) {
  if (typed) return *typed == "Z" ? UpAxis::z : UpAxis::y;
  return loaded.statesUp ? std::optional(UpAxis::y) : std::nullopt;
}

}  // namespace ringlet::program
