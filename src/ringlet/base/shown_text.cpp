// Implements base/shown_text.h.
#include "ringlet/base/shown_text.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>

namespace ringlet {
namespace {

struct Character {
  std::size_t byteCount = 1;
  std::uint32_t code = 0;
  bool isValid = false;
};

// The first of a text: its shortest form only, no half of a pair, none beyond Unicode.
Character firstOf(std::string_view text) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {1, lead, true};
  const std::size_t count = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < count) return {};
  std::uint32_t code = lead & (0x7fu >> count);
  for (std::size_t k = 1; k < count; ++k) {
    if ((byte(k) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(k) & 0x3fu);
  }
  const bool isTooLong = (count == 3 && code < 0x800) || (count == 4 && code < 0x10000);
  const bool isNone = (code >= 0xd800 && code < 0xe000) || code > 0x10ffff;
  return isTooLong || isNone ? Character{} : Character{count, code, true};
}

bool isOfC1(std::uint32_t code) { return code >= 0x7f && code < 0xa0; }  // with DEL

}  // namespace

std::string shownText(std::string_view text) {
  std::string shown;
  shown.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const Character c = firstOf(text.substr(at));
    const bool isControl = c.code < 0x20 && c.code != '\n' && c.code != '\t';
    if (c.isValid && !isControl && !isOfC1(c.code)) {
      shown += text.substr(at, c.byteCount);
    } else {
      shown += fmt::format("\\x{:02x}", c.isValid ? c.code : static_cast<unsigned char>(text[at]));
    }
    at += c.byteCount;
  }
  return shown;
}

std::string shownJson(std::string_view json) {
  std::string shown;
  shown.reserve(json.size());
  for (std::size_t at = 0; at < json.size();) {
    const Character c = firstOf(json.substr(at));
    if (c.isValid && isOfC1(c.code)) {
      shown += fmt::format("\\u{:04x}", c.code);
    } else {
      shown += json.substr(at, c.byteCount);
    }
    at += c.byteCount;
  }
  return shown;
}

}  // namespace ringlet
