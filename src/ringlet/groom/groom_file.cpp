// Implements groom/groom_file.h.
#include "ringlet/groom/groom_file.h"

#include <fmt/format.h>

#include <cstddef>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/groom/hair_file.h"
#include "ringlet/groom/obj_file.h"
#include "ringlet/groom/whole_file.h"

namespace ringlet {
namespace {

enum class Format { hair, obj };

std::optional<Format> formatOf(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  if (extension == ".hair") return Format::hair;
  if (extension == ".obj") return Format::obj;
  return std::nullopt;
}

Error unknownExtension(const std::filesystem::path& path, const char* attempt) {
  const std::string extension = path.extension().string();
  return {fmt::format("{}: cannot {} a groom: {}; supported are .hair and .obj", path.string(), attempt,
                      extension.empty() ? std::string("the name has no extension")
                                        : fmt::format("the extension '{}' is unknown", extension))};
}

}  // namespace

Result<LoadedGroom> readGroom(const std::filesystem::path& path) {
  const std::optional<Format> format = formatOf(path);
  if (!format) return unknownExtension(path, "read");
  try {
    Result<std::vector<std::byte>> bytes = readWholeFile(path);
    if (!bytes) return bytes.error();
    return *format == Format::hair ? readHair(*bytes, path) : readObj(*bytes, path);
  } catch (const std::bad_alloc&) {
    return Error{fmt::format("{}: reading it needs more memory than there is", path.string())};
  }
}

Status writeGroom(const std::filesystem::path& path, const Groom& groom) {
  const std::optional<Format> format = formatOf(path);
  if (!format) return unknownExtension(path, "write");
  return *format == Format::hair ? writeHair(path, groom) : writeObj(path, groom);
}

}  // namespace ringlet
