// Formats a length for people.
#pragma once

#include <fmt/format.h>

#include <string>

namespace ringlet {

/// "240 mm", "1.3 m".
inline std::string lengthText(double metres) {
  return metres < 1 ? fmt::format("{:.3g} mm", 1000 * metres) : fmt::format("{:.3g} m", metres);
}

}  // namespace ringlet
