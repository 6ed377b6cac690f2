// Implements motion/gltf_bytes.h.
#include "ringlet/motion/gltf_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace ringlet {
namespace {

constexpr std::size_t kLargest = 0xfff00000;     // TinyGLTF counts bytes in 32 bits
constexpr int kDeepest = 200;                    // brackets within brackets; glTF itself needs a dozen
constexpr std::uint32_t kText = 0x4e4f534a;      // "JSON"
constexpr std::uint32_t kBinary = 0x004e4942;    // "BIN"
constexpr std::size_t kHeader = 12, kChunk = 8;  // [bytes]

std::uint32_t numberAt(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t k = 4; k-- > 0;) number = number << 8 | std::to_integer<std::uint32_t>(bytes[at + k]);
  return number;
}

Status guardText(std::span<std::byte> bytes, bool hidesMeshes) {
  constexpr std::array<std::string_view, 6> kUnread{"images",   "textures",   "materials",
                                                    "samplers", "extensions", "extras"};
  char* const text = reinterpret_cast<char*>(bytes.data());
  int depth = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (text[i] == '{' || text[i] == '[') ++depth;
    if (text[i] == '}' || text[i] == ']') --depth;
    if (depth > kDeepest)
      return Error{fmt::format("byte {}: brackets stand more than {} deep in each other", i, kDeepest)};
    if (text[i] != '"') continue;
    const std::size_t start = ++i;
    while (i < bytes.size() && text[i] != '"') i += text[i] == '\\' ? 2 : 1;
    const std::size_t size = std::min(i, bytes.size()) - start;
    if (depth != 1) continue;
    const std::string_view word(text + start, size);
    if (word.find('\\') != std::string_view::npos)
      return Error{fmt::format("byte {}: a member's name is not plain", start)};
    if (std::ranges::find(kUnread, word) != kUnread.end() || (hidesMeshes && word == "meshes"))
      text[start] = '-';
  }
  return {};
}

}  // namespace

Result<GltfForm> guardGltf(std::span<std::byte> bytes, bool hidesMeshes) {
  if (bytes.size() > kLargest)
    return Error{fmt::format("it has {} bytes; at most {} can be read", bytes.size(), kLargest)};
  constexpr std::uint32_t kMagic = 0x46546c67;  // "glTF"
  if (bytes.size() < 4 || numberAt(bytes, 0) != kMagic) {
    if (Status status = guardText(bytes, hidesMeshes); !status) return status.error();
    return GltfForm::text;
  }
  if (bytes.size() < kHeader + kChunk)
    return Error{fmt::format("a .glb has at least {} bytes, not {}", kHeader + kChunk, bytes.size())};
  if (numberAt(bytes, 4) != 2)
    return Error{fmt::format("it is of version {}; version 2 can be read", numberAt(bytes, 4))};
  const std::uint64_t whole = numberAt(bytes, 8), text = numberAt(bytes, 12);
  if (whole > bytes.size())
    return Error{fmt::format("it says it has {} bytes, but has {}", whole, bytes.size())};
  if (numberAt(bytes, 16) != kText || text > whole - std::min<std::uint64_t>(whole, kHeader + kChunk))
    return Error{fmt::format("its first chunk, of {} bytes, is not its text", text)};
  const std::uint64_t second = kHeader + kChunk + text;
  if (second + kChunk <= whole) {
    const std::uint64_t size = numberAt(bytes, static_cast<std::size_t>(second));
    if (numberAt(bytes, static_cast<std::size_t>(second) + 4) == kBinary && size > whole - second - kChunk)
      return Error{fmt::format("its second chunk ends {} bytes beyond it", size - (whole - second - kChunk))};
  }
  if (Status status = guardText(bytes.subspan(kHeader + kChunk, static_cast<std::size_t>(text)), hidesMeshes);
      !status)
    return status.error();
  return GltfForm::binary;
}

std::string_view gltfText(std::span<const std::byte> bytes, GltfForm form) {
  const std::span<const std::byte> text =
      form == GltfForm::text ? bytes : bytes.subspan(kHeader + kChunk, numberAt(bytes, kHeader));
  return {reinterpret_cast<const char*>(text.data()), text.size()};
}

}  // namespace ringlet
