// Bytes as characters.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace ringlet {

/// The same bytes.
inline std::string_view textOf(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace ringlet
