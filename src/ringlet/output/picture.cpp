// Implements output/picture.h.
#include "ringlet/output/picture.h"

#include <fmt/format.h>
#include <png.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "ringlet/base/whole_file.h"

namespace ringlet {
namespace {

constexpr int kDigitWidth = 5, kDigitHeight = 7;

// Seven rows of five dots a digit.
constexpr std::array<std::array<const char*, kDigitHeight>, 10> kDigits{{
    {" ### ", "#   #", "#  ##", "# # #", "##  #", "#   #", " ### "},
    {"  #  ", " ##  ", "  #  ", "  #  ", "  #  ", "  #  ", " ### "},
    {" ### ", "#   #", "    #", "   # ", "  #  ", " #   ", "#####"},
    {" ### ", "#   #", "    #", "  ## ", "    #", "#   #", " ### "},
    {"   # ", "  ## ", " # # ", "#  # ", "#####", "   # ", "   # "},
    {"#####", "#    ", "#### ", "    #", "    #", "#   #", " ### "},
    {" ### ", "#    ", "#    ", "#### ", "#   #", "#   #", " ### "},
    {"#####", "    #", "   # ", "  #  ", "  #  ", "  #  ", "  #  "},
    {" ### ", "#   #", "#   #", " ### ", "#   #", "#   #", " ### "},
    {" ### ", "#   #", "#   #", " ####", "    #", "    #", " ### "},
}};

}  // namespace

void Picture::drawNumber(int number, int x, int y, int dot, Colour colour) {
  for (char digit : fmt::format("{}", number)) {
    if (digit < '0' || digit > '9') continue;
    for (int row = 0; row < kDigitHeight * dot; ++row) {
      for (int column = 0; column < kDigitWidth * dot; ++column) {
        bool inside = x + column >= 0 && x + column < width && y + row >= 0 && y + row < height;
        if (inside && kDigits[digit - '0'][row / dot][column / dot] == '#') at(x + column, y + row) = colour;
      }
    }
    x += (kDigitWidth + 1) * dot;
  }
}

Status Picture::writePng(const std::filesystem::path& path) const {
  static_assert(sizeof(Colour) == 3, "three bytes a pixel, as PNG has it");
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;

  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<std::byte> bytes(size);
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr)) {
    return Error{fmt::format("cannot make the picture {}: {}", path.string(), image.message)};
  }
  bytes.resize(size);
  return writeWholeFile(path, bytes);
}

}  // namespace ringlet
