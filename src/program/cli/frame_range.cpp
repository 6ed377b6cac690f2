// Implements frame_range.h.
#include "program/cli/frame_range.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <charconv>

namespace ringlet::program {

std::optional<FrameRange> parseFrameRange(const std::string& text) {
  const char *at = text.data(), *end = at + text.size();
  FrameRange range;
  const auto [colon, first] = std::from_chars(at, end, range.first);
  if (first != std::errc()) return std::nullopt;
  range.last = range.first;
  if (colon != end) {
    if (*colon != ':') return std::nullopt;
    const auto [stop, last] = std::from_chars(colon + 1, end, range.last);
    if (last != std::errc() || stop != end) return std::nullopt;
  }
  if (range.first < 1 || range.last < range.first) return std::nullopt;
  return range;
}

CLI::Validator isFrameRange() {
  return CLI::Validator(
      [](std::string& text) {
        if (parseFrameRange(text)) return std::string();
        return fmt::format("must be a frame from 1 up, as 12, or the first and the last, as 1:24, not '{}'",
                           text);
      },
      "");
}

}  // namespace ringlet::program
