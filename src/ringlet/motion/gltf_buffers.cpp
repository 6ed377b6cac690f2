// Implements motion/gltf_buffers.h.
#include "ringlet/motion/gltf_buffers.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>
#include <system_error>

#include "ringlet/base/whole_file.h"
#include "ringlet/motion/gltf_bytes.h"
#include "ringlet/motion/name_below.h"

namespace ringlet {
namespace {

using nlohmann::json;

std::optional<int> digitOf(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return std::nullopt;
}

// All of a file's text but its buffers is dropped.
json buffersIn(std::string_view text) {
  const auto keeps = [](int depth, json::parse_event_t event, const json& parsed) {
    return event != json::parse_event_t::key || depth != 1 || parsed == "buffers";
  };
  const json tree = json::parse(text, keeps, false);
  return tree.is_object() && tree.contains("buffers") ? tree["buffers"] : json::array();
}

}  // namespace

std::string decodedUri(std::string_view uri) {
  std::string name;
  for (std::size_t k = 0; k < uri.size(); ++k) {
    const auto high = uri[k] == '%' && k + 2 < uri.size() ? digitOf(uri[k + 1]) : std::nullopt;
    const auto low = high ? digitOf(uri[k + 2]) : std::nullopt;
    name += low ? static_cast<char>(*high * 16 + *low) : uri[k];
    if (low) k += 2;
  }
  return name;
}

Result<std::vector<GltfBuffer>> gltfBuffersOf(std::string_view text, const std::filesystem::path& folder) {
  std::vector<GltfBuffer> buffers;
  const json found = buffersIn(text);
  for (std::size_t b = 0; found.is_array() && b < found.size(); ++b) {
    if (!found[b].is_object() || !found[b].contains("uri") || !found[b]["uri"].is_string()) continue;
    const auto& uri = found[b]["uri"].get_ref<const std::string&>();
    if (uri.empty() || uri.starts_with("data:")) continue;
    const std::string name = decodedUri(uri);
    if (const std::string refusal = whyNotBelow(name, folder, "glTF"); !refusal.empty()) {
      return Error{fmt::format(
          "buffer {}: the file {} {}; buffers are read from the folder of the glTF file and below it, and "
          "from nowhere else",
          b, name, refusal)};
    }
    const json& size = found[b].contains("byteLength") ? found[b]["byteLength"] : json();
    buffers.push_back({folder / name, size.is_number_unsigned() ? size.get<std::uint64_t>() : 0});
  }
  return buffers;
}

std::vector<std::filesystem::path> gltfBufferFiles(const std::filesystem::path& path) {
  auto bytes = readWholeFile(path);
  if (!bytes) return {};
  const auto form = guardGltf(*bytes, false);
  if (!form) return {};
  const auto buffers = gltfBuffersOf(gltfText(*bytes, *form), path.parent_path());
  std::vector<std::filesystem::path> files;
  if (buffers) {
    for (const GltfBuffer& buffer : *buffers) files.push_back(buffer.file);
  }
  return files;
}

Status checkGltfBuffers(std::span<const GltfBuffer> buffers) {
  for (const GltfBuffer& buffer : buffers) {
    const std::string name = buffer.file.string();
    std::error_code code;
    const auto status = std::filesystem::status(buffer.file, code);
    if (!std::filesystem::exists(status))
      return Error{fmt::format("its buffer {} is not there", name), Fault::input};
    if (!std::filesystem::is_regular_file(status))
      return Error{fmt::format("its buffer {} is not a regular file", name), Fault::input};
    const std::uintmax_t size = std::filesystem::file_size(buffer.file, code);
    if (code) return Error{fmt::format("its buffer {}: {}", name, code.message()), Fault::input};
    if (size != buffer.byteCount)
      return Error{
          fmt::format("its buffer {} has {} bytes, where byteLength is {}", name, size, buffer.byteCount)};
  }
  return {};
}

}  // namespace ringlet
