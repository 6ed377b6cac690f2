// Implements view/widget_file.h.
#include "view/widget_file.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

namespace ringlet::view {

Status writeWidgets(const std::filesystem::path& path, const WindowState& state,
                    const WidgetPlaces& widgets) {
  const auto listOf = [](Vec3d v) { return nlohmann::json{v.x, v.y, v.z}; };
  nlohmann::json json{
      {"frames", state.shownFrames},        {"picture", {0, 0, state.pictureWidth, state.pictureHeight}},
      {"playing", state.isPlaying},         {"eye", listOf(state.eye)},
      {"head", listOf(state.head)},         {"dragged", state.dragged},
      {"message", state.message},           {"solids", nlohmann::json::array()},
      {"widgets", nlohmann::json::object()}};
  for (const Vec3d& solid : state.solids) json["solids"].push_back(listOf(solid));
  for (const auto& [name, place] : widgets) json["widgets"][name] = place;
  // Readers see a whole file or the one before. It is not for keeps, so the disk is not waited for.
  const std::filesystem::path written = path.string() + ".partial";
  std::error_code code;
  std::filesystem::remove(written, code);  // a symbolic link of that name would be followed
  std::ofstream out(written);
  out << json.dump() << '\n';
  out.close();
  if (out) std::filesystem::rename(written, path, code);
  if (!out || code)
    return Error{
        fmt::format("cannot write {}: {}", path.string(), code ? code.message() : "no room, or no folder"),
        Fault::output};
  return {};
}

}  // namespace ringlet::view
