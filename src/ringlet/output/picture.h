// Picture: a rectangle of colours, written as PNG.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"

namespace ringlet {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;  // sRGB
  bool operator==(const Colour&) const = default;
};

struct Picture {
  int width = 0, height = 0;
  std::vector<Colour> pixels;  // row by row from the top, width * height

  Picture(int w, int h, Colour fill) : width(w), height(h), pixels(static_cast<std::size_t>(w) * h, fill) {}
  Colour& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }

  /// Draws digits, capitals, which stand for small letters too, and . , - + _ = / : % of 5 x 7 dots, one
  /// apart; anything else is a gap. Its top left corner is at (x, y), each dot `dot` pixels wide; parts
  /// outside are left out.
  void drawText(std::string_view text, int x, int y, int dot, Colour colour);

  Status writePng(const std::filesystem::path& path) const;
};

}  // namespace ringlet
