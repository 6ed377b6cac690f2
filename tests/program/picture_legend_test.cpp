// program/picture_legend.h: the bar goes from the first colour to the last, in pictures of every size.
#include "ringlet/pictures/picture_legend.h"

#include <gtest/gtest.h>

namespace ringlet::program::picture_legend_test {
namespace {

constexpr Colour kGrey{10, 10, 10};

TEST(PictureLegend, GoesFromBlueToRed) {
  Picture picture(480, 270, kGrey);
  drawLegend({"stretch", "5 %"}, picture);
  // The bar: the only rows whose pixels are all coloured from the margin on.
  int rows = 0;
  for (int y = 0; y < 270; ++y) {
    bool isBar = true;
    for (int x = 14; x < 14 + 120; ++x) isBar = isBar && !(picture.at(x, y).red == picture.at(x, y).blue);
    if (!isBar) continue;
    ++rows;
    const Colour first = picture.at(14, y), last = picture.at(133, y);
    EXPECT_GT(first.blue, first.red + 100);
    EXPECT_GT(last.red, last.blue + 100);
    EXPECT_GT(picture.at(54, y).green, picture.at(54, y).red + 40);  // a third of the way
    EXPECT_EQ(picture.at(134, y), kGrey);
    EXPECT_EQ(picture.at(13, y), kGrey);
  }
  EXPECT_EQ(rows, 5);
}

TEST(PictureLegend, TheLastColoursNumberIsWritten) {
  Picture five(480, 270, kGrey), six(480, 270, kGrey);
  drawLegend({"stretch", "5 %"}, five);
  drawLegend({"stretch", "6 %"}, six);
  EXPECT_NE(five.pixels, six.pixels);
}

TEST(PictureLegend, FitsEverySize) {
  for (const int width : {1, 13, 15, 40, 3000})
    for (const int height : {1, 14, 20, 2000}) {
      Picture picture(width, height, kGrey);
      drawLegend({"contacts", "0.001 mm"}, picture);
      EXPECT_EQ(picture.pixels.size(), static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    }
}

}  // namespace
}  // namespace ringlet::program::picture_legend_test
