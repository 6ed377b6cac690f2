// Implements picture_legend.h.
#include "ringlet/pictures/picture_legend.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/render/look.h"

namespace ringlet {
namespace {

constexpr Colour kWords{190, 190, 190};
constexpr int kMargin = 14;                     // [pixels]
constexpr int kLetterHeight = 7, kAdvance = 6;  // [dots], of Picture::drawText

int widthOf(std::string_view text, int dot) { return (kAdvance * static_cast<int>(text.size()) - 1) * dot; }

// Encodes linear light as sRGB.
std::uint8_t encoded(double light) {
  const double x = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(x, 0.0, 1.0)));
}

// The colour at this share of the scale. Pigments are mixed, so logarithms of colours are interpolated.
Colour colourAt(double share) {
  const std::vector<Vec3d> colours = scaleColours();
  const double at = share * static_cast<double>(colours.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(at), colours.size() - 2);
  const double t = at - static_cast<double>(k);
  const Vec3d a = colours[k], b = colours[k + 1];
  const auto mixed = [&](double x, double y) { return encoded(std::pow(x, 1 - t) * std::pow(y, t)); };
  return {mixed(a.x, b.x), mixed(a.y, b.y), mixed(a.z, b.z)};
}

}  // namespace

void drawLegend(const PictureLegend& legend, Picture& picture) {
  const int dot = std::max(1, picture.height / 270), line = (kLetterHeight + 3) * dot;
  const int words = std::max(widthOf(legend.title, dot), widthOf("0 " + legend.end, dot));
  const int width = std::min(std::max(picture.width / 4, words), picture.width - kMargin);
  const int bottom = picture.height - kMargin;
  picture.drawText("0", kMargin, bottom - kLetterHeight * dot, dot, kWords);
  picture.drawText(legend.end, kMargin + width - widthOf(legend.end, dot), bottom - kLetterHeight * dot, dot,
                   kWords);
  const int barEnd = bottom - line, barBegin = barEnd - 5 * dot;
  for (int y = std::max(barBegin, 0); y < barEnd; ++y)
    for (int x = 0; x < width; ++x)
      picture.at(kMargin + x, y) = colourAt(static_cast<double>(x) / std::max(width - 1, 1));
  picture.drawText(legend.title, kMargin, barBegin - line, dot, kWords);
}

}  // namespace ringlet
