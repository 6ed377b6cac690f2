// Implements base/quoted.h.
#include "ringlet/base/quoted.h"

#include <fmt/format.h>

namespace ringlet {

std::string quoted(std::string_view text) {
  constexpr std::size_t kLongest = 32;  // enough to recognise it, short enough for one line
  std::string out = "'";
  for (char c : text.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) {
      out += c;
    } else {
      out += fmt::format("\\x{:02x}", byte);
    }
  }
  out += text.size() > kLongest ? "...'" : "'";
  return out;
}

}  // namespace ringlet
