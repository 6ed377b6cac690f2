// sheet.png: which frames, where strands are drawn, what hides what.
#include "ringlet/output/sheet.h"

#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/test_support.h"

namespace ringlet::sheet_test {
namespace {

Groom strands(std::initializer_list<std::vector<Vec3f>> all) {
  Groom groom;
  for (const auto& strand : all) groom.addStrand(strand);
  return groom;
}

// Where a panel is drawn on, its label and the dividing lines left out.
struct Drawn {
  int left = kPanelWidth, right = -1, top = kPanelHeight, bottom = -1;
  int width() const { return right - left + 1; }
  int height() const { return bottom - top + 1; }
};
std::optional<Drawn> drawnIn(Picture& picture, int panel) {
  const Colour background = picture.at(panel * kPanelWidth + kPanelWidth / 2, 2);
  Drawn drawn;
  for (int y = 0; y < kPanelHeight - 40; ++y) {
    for (int x = 1; x < kPanelWidth; ++x) {
      if (picture.at(panel * kPanelWidth + x, y) == background) continue;
      drawn.left = std::min(drawn.left, x);
      drawn.right = std::max(drawn.right, x);
      drawn.top = std::min(drawn.top, y);
      drawn.bottom = std::max(drawn.bottom, y);
    }
  }
  if (drawn.right < 0) return std::nullopt;
  return drawn;
}

TEST(SheetFrames, AreEvenWithFirstAndLast) {
  EXPECT_EQ(sheetFrames(48), (std::vector<int>{1, 10, 20, 29, 39, 48}));
  EXPECT_EQ(sheetFrames(6), (std::vector<int>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(sheetFrames(3), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(sheetFrames(1), (std::vector<int>{1}));
  EXPECT_EQ(sheetFrames(2'000'000'000).back(), 2'000'000'000);
}

// A strand of three edges, whose middle one is no more.
TEST(Sheet, DrawsNoEdgeAtACut) {
  const Groom groom = strands({{{0, 0, 0}, {0, -1, 0}, {0, -2, 0}, {0, -3, 0}}});
  const auto rowsDrawn = [&](const std::vector<std::uint32_t>& cutBeyond) {
    Sheet sheet(groom, 1, UpAxis::y);
    sheet.offer(1, groom.points, {}, cutBeyond);
    Archive out = Archive::writing();
    sheet.archive(out);
    Sheet again(groom, 1, UpAxis::y);
    const auto bytes = out.take();
    Archive in = Archive::reading(bytes);
    again.archive(in);
    Picture picture = again.draw();
    int rows = 0;
    for (int y = 0; y < kPanelHeight - 40; ++y) {
      bool isDrawn = false;
      for (int x = 1; x < kPanelWidth; ++x)
        isDrawn = isDrawn || picture.at(x, y) != picture.at(kPanelWidth / 2, 2);
      rows += isDrawn;
    }
    return rows;
  };
  const int whole = rowsDrawn({});
  EXPECT_NEAR(rowsDrawn({1}), whole * 2 / 3, 8);  // ends are round
  EXPECT_NEAR(rowsDrawn({0, 1}), whole / 3, 16);
}

TEST(Sheet, DrawsSixPanelsFilledAndCentred) {
  const Groom groom = strands({{{0, 0, 0}, {0, -1, 0}, {0, -2, 0}}});
  Sheet sheet(groom, 48, UpAxis::y);
  for (int frame = 1; frame <= 48; ++frame) sheet.offer(frame, groom.points);
  Picture picture = sheet.draw();
  EXPECT_EQ(picture.width, 6 * 480);
  EXPECT_EQ(picture.height, 640);
  for (int panel = 0; panel < 6; ++panel) {
    const auto drawn = drawnIn(picture, panel);
    ASSERT_TRUE(drawn) << "panel " << panel;
    EXPECT_GT(drawn->height(), 500);
    EXPECT_LT(drawn->width(), 10) << "a vertical strand is upright";
    EXPECT_NEAR((drawn->left + drawn->right) / 2.0, kPanelWidth / 2.0, 2);
  }
}

TEST(Sheet, UpIsUp) {
  // The root is above the tip, whichever axis is up: it is darker than the tip.
  const Groom groom = strands({{{0, 0, 0}, {0, 0, -1}, {0, 0, -2}}});
  Sheet sheet(groom, 1, UpAxis::z);
  sheet.offer(1, groom.points);
  Picture picture = sheet.draw();
  const auto drawn = drawnIn(picture, 0);
  ASSERT_TRUE(drawn);
  EXPECT_GT(drawn->height(), 500);
  const int middle = (drawn->left + drawn->right) / 2;
  EXPECT_LT(picture.at(middle, drawn->top + 20).green, picture.at(middle, drawn->bottom - 20).green);
}

TEST(Sheet, OneCameraShowsTheMotion) {
  const Groom groom = strands({{{0, 0, 0}, {0, -2, 0}}});
  Sheet sheet(groom, 6, UpAxis::y);
  for (int frame = 1; frame <= 6; ++frame) {
    auto points = groom.points;
    for (Vec3f& p : points) p.x += 0.2f * static_cast<float>(frame);
    sheet.offer(frame, points);
  }
  Picture picture = sheet.draw();
  int before = -1;
  for (int panel = 0; panel < 6; ++panel) {
    const auto drawn = drawnIn(picture, panel);
    ASSERT_TRUE(drawn);
    EXPECT_GT(drawn->left, before) << "+X moves to the right, panel " << panel;
    before = drawn->left;
  }
}

// However far it goes, in whichever direction: hair is at least half as large as that which stays in place.
TEST(Sheet, NoMotionMakesHairSmall) {
  const Groom groom = strands({{{0, 0, 0}, {0, -2, 0}}});
  const auto leastHeight = [&](Vec3f travel) {
    Sheet sheet(groom, 6, UpAxis::y);
    for (int frame = 1; frame <= 6; ++frame) {
      auto points = groom.points;
      for (Vec3f& p : points) p += travel * static_cast<float>(frame - 1);
      sheet.offer(frame, points);
    }
    Picture picture = sheet.draw();
    int least = kPanelHeight;
    for (int panel = 0; panel < 6; ++panel) {
      const auto drawn = drawnIn(picture, panel);
      least = std::min(least, drawn ? drawn->height() : 0);
    }
    return least;
  };
  const int still = leastHeight({});
  for (const Vec3f way : {Vec3f{1, 0, 0}, Vec3f{0, 1, 0}, Vec3f{0, 0, 1}}) {
    for (float step = 0.01f; step < 1000; step *= 2)
      EXPECT_GE(leastHeight(way * step), still / 2 - 4) << step << " of " << way.x << way.y << way.z;
  }
}

TEST(Sheet, AnEarlyEndShowsTheLatestFrame) {
  const Groom groom = strands({{{0, 0, 0}, {0, -2, 0}}});
  Sheet sheet(groom, 48, UpAxis::y);
  for (int frame = 1; frame <= 15; ++frame) sheet.offer(frame, groom.points);
  Picture picture = sheet.draw();
  for (int panel = 0; panel < 6; ++panel) EXPECT_EQ(drawnIn(picture, panel).has_value(), panel < 3) << panel;
}

TEST(Sheet, NearStrandsHideFarOnesInAnyOrder) {
  // A lying strand in front of a standing one; specks at the corners of a cube keep the camera the same
  // without it.
  const std::vector<Vec3f> front{{-1, -0.5f, 1}, {1, -0.5f, 1}}, behind{{0, -1, -1}, {0, 1, -1}},
      speck{{1, 1, 1}, {1, 1, 1}};
  auto drawn = [&](std::initializer_list<std::vector<Vec3f>> crossing) {
    Groom groom = strands(crossing);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3f at{corner & 1 ? 1.0f : -1.0f, corner & 2 ? 1.0f : -1.0f, corner & 4 ? 1.0f : -1.0f};
      groom.addStrand(std::vector<Vec3f>{at, at});
    }
    Sheet sheet(groom, 1, UpAxis::y);
    sheet.offer(1, groom.points);
    return sheet.draw();
  };
  for (bool frontFirst : {true, false}) {
    Picture without = frontFirst ? drawn({front, speck}) : drawn({speck, front});
    Picture with = frontFirst ? drawn({front, behind}) : drawn({behind, front});
    EXPECT_NE(without.pixels, with.pixels) << "the strand behind is drawn";

    // Down each column between the specks, the brightest pixel is the middle of the strand in front.
    int compared = 0, hidden = 0;
    for (int x = kPanelWidth / 4; x < kPanelWidth * 3 / 4; ++x) {
      int brightest = kPanelHeight / 2;
      for (int y = kPanelHeight / 2; y < kPanelHeight * 3 / 4; ++y) {
        if (without.at(x, y).red > without.at(x, brightest).red) brightest = y;
      }
      if (without.at(x, brightest).red < 100) continue;
      ++compared;
      if (without.at(x, brightest) != with.at(x, brightest)) ++hidden;
    }
    EXPECT_GT(compared, 100);
    EXPECT_EQ(hidden, 0) << "columns in which the strand in front is hidden";
  }
}

TEST(Sheet, SurvivesWhatACrashLooksLike) {
  // One point for all particles, and coordinates at the end of what a float holds.
  for (float size : {0.0f, 1e30f}) {
    const Groom groom = strands({{{size, 0, 0}, {0, -size, size}}, {{0, 0, 0}, {0, 0, 0}}});
    Sheet sheet(groom, 1, UpAxis::y);
    sheet.offer(1, groom.points);
    Picture picture = sheet.draw();
    EXPECT_TRUE(drawnIn(picture, 0)) << size;
  }
}

// Panels in rows, seen by one camera: hair twice as long is drawn twice as large.
TEST(Panels, ShareACameraAndStandInRows) {
  const Groom small = strands({{{0, 0, 0}, {0, -1, 0}}}), large = strands({{{0, 0, 0}, {0, -2, 0}}});
  const std::vector<Panel> panels = {{small.firstPoint, small.points}, {}, {large.firstPoint, large.points}};
  Picture picture = drawPanels(panels, {.columns = 3});
  ASSERT_EQ(picture.width, 3 * kPanelWidth);
  ASSERT_EQ(picture.height, kPanelHeight);
  const auto first = drawnIn(picture, 0), third = drawnIn(picture, 2);
  ASSERT_TRUE(first && third);
  EXPECT_FALSE(drawnIn(picture, 1)) << "without points";
  EXPECT_NEAR(third->height(), 2 * first->height(), 0.05 * third->height()) << "but for perspective";

  // In a column the same panels are the same pixels, one below the other.
  Picture column = drawPanels(panels, {.columns = 1, .rows = 3});
  ASSERT_EQ(column.height, 3 * kPanelHeight);
  for (int panel = 0; panel < 3; ++panel) {
    for (int y = 1; y < kPanelHeight; ++y) {
      for (int x = 1; x < kPanelWidth; ++x)
        ASSERT_EQ(picture.at(panel * kPanelWidth + x, y), column.at(x, panel * kPanelHeight + y)) << panel;
    }
  }
}

TEST(Panels, SmallPanelsShowTheSameSmaller) {
  const Groom groom = strands({{{0, 0, 0}, {1, -1, 0}, {0, -2, 0}}});
  const std::vector<Panel> panels = {{groom.firstPoint, groom.points, {"a", "hold 0.5"}}};
  Picture large = drawPanels(panels, {.columns = 1}),
          small = drawPanels(panels, {.columns = 1, .width = kPanelWidth / 2, .height = kPanelHeight / 2});
  ASSERT_EQ(small.width, kPanelWidth / 2);
  const Colour background = small.at(1, 1);
  const auto rowsOf = [&](Picture& picture) {
    int first = picture.height, last = 0;
    for (int y = 0; y < picture.height * 4 / 5; ++y) {  // above the labels
      if (picture.at(picture.width / 2, y) == background) continue;
      first = std::min(first, y);
      last = y;
    }
    return std::pair(first, last);
  };
  EXPECT_NEAR(rowsOf(large).first, 2 * rowsOf(small).first, 8);
}

TEST(Picture, TextIsDigitsCapitalsAndSigns) {
  const auto dotsOf = [](const char* text) {
    Picture picture(200, 9, {});
    picture.drawText(text, 1, 1, 1, {9, 9, 9});
    return picture.pixels;
  };
  EXPECT_EQ(dotsOf("hold"), dotsOf("HOLD"));
  EXPECT_EQ(dotsOf("~ ~"), dotsOf("   "));
  const std::string all = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ.,-+_=/:";
  for (const char a : all) {
    for (const char b : all) {
      const char one[] = {a, 0}, other[] = {b, 0};
      EXPECT_EQ(dotsOf(one) == dotsOf(other), a == b) << a << b;
    }
    const char one[] = {a, 0};
    EXPECT_NE(dotsOf(one), dotsOf(" ")) << a;
  }
}

TEST(Picture, PngHoldsThePixels) {
  const auto path = test::scratchFolder("png") / "picture.png";
  Picture picture(30, 20, {1, 2, 3});
  picture.at(29, 19) = {250, 251, 252};
  picture.drawText("17", 1, 1, 1, {9, 9, 9});
  auto written = picture.writePng(path);
  ASSERT_TRUE(written) << written.error().message;

  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_file(&image, path.c_str())) << image.message;
  image.format = PNG_FORMAT_RGB;
  ASSERT_EQ(image.width, 30u);
  ASSERT_EQ(image.height, 20u);
  std::vector<Colour> pixels(30 * 20);
  ASSERT_TRUE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr)) << image.message;
  EXPECT_EQ(pixels, picture.pixels);
  EXPECT_EQ(std::count(pixels.begin(), pixels.end(), Colour{9, 9, 9}), 10 + 11) << "dots of a 1 and a 7";
}

TEST(Picture, SaysWhyItCannotBeWritten) {
  const auto path = test::scratchFolder("png_missing") / "no" / "picture.png";
  auto written = Picture(2, 2, {}).writePng(path);
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find(path.string()), std::string::npos) << written.error().message;
}

// A square across the view of Y up, in metres, facing the camera or away from it.
SheetSolid square(double half, bool facesCamera = true) {
  SheetSolid solid;
  const Vec3d right{std::cos(35 * std::numbers::pi / 180), 0, -std::sin(35 * std::numbers::pi / 180)};
  for (const auto& [u, v] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
    solid.points.push_back(right * (u * half) + Vec3d{0, v * half, 0});
  solid.triangles = {{0, 1, 2}, {0, 2, 3}};
  if (!facesCamera) solid.triangles = {{0, 2, 1}, {0, 3, 2}};
  return solid;
}
// Towards the camera, level.
Vec3d towardsCamera(double metres) {
  const double yaw = 35 * std::numbers::pi / 180;
  return Vec3d{std::sin(yaw), 0, std::cos(yaw)} * metres;
}

bool isHair(Colour c) { return c.red > c.blue + 20; }
bool isSkin(Colour c) { return c.blue > c.red && c.blue > 50; }

struct Count {
  int hair = 0, skin = 0;
};
Count countOf(Picture& picture, int panel = 0) {
  Count count;
  for (int y = 0; y < kPanelHeight - 40; ++y) {
    for (int x = 1; x < kPanelWidth; ++x) {
      const Colour c = picture.at(panel * kPanelWidth + x, y);
      count.hair += isHair(c) ? 1 : 0;
      count.skin += isSkin(c) ? 1 : 0;
    }
  }
  return count;
}

// A strand of 20 cm, hanging, and a square of 4 cm about its middle: before it, behind it, turned away.
TEST(Sheet, SolidsHideHairThatIsBehindThem) {
  const Groom groom = strands({{{0, 10, 0}, {0, 0, 0}, {0, -10, 0}}});
  const auto drawn = [&](double before, bool facesCamera) {
    Sheet sheet(groom, 1, UpAxis::y, {square(0.02, facesCamera)});
    sheet.offer(1, groom.points, std::vector<SheetPlace>{{towardsCamera(before), {}}});
    Picture picture = sheet.draw();
    return countOf(picture);
  };
  Sheet bare(groom, 1, UpAxis::y);
  bare.offer(1, groom.points);
  Picture alone = bare.draw();
  const int all = countOf(alone).hair;
  ASSERT_GT(all, 500);
  EXPECT_EQ(countOf(alone).skin, 0);
  const Count behind = drawn(-0.05, true), before = drawn(0.05, true), away = drawn(0.05, false);
  EXPECT_GT(behind.hair, all - 20);
  EXPECT_GT(behind.skin, 5000);
  EXPECT_NEAR(before.hair, 0.8 * all, 0.05 * all) << "a fifth of the strand is behind the square";
  EXPECT_GT(before.skin, behind.skin);
  EXPECT_EQ(away.skin, 0);
  EXPECT_EQ(away.hair, all);
  const Count touching = drawn(0.0001, true);  // on the solid, less far than the strand is thick
  EXPECT_GT(touching.hair, all - 20);
}

TEST(Sheet, SolidsMoveAndTurn) {
  const Groom groom = strands({{{0, 10, 0}, {0, 0, 0}, {0, -10, 0}}});
  Sheet sheet(groom, 3, UpAxis::y, {square(0.02)});
  const Quatd quarter = fromRotationVector(Vec3d{0, std::numbers::pi / 2, 0});
  sheet.offer(1, groom.points, std::vector<SheetPlace>{{{}, {}}});
  sheet.offer(2, groom.points, std::vector<SheetPlace>{{{0.04, 0, 0}, {}}});
  sheet.offer(3, groom.points, std::vector<SheetPlace>{{{}, quarter}});
  Picture picture = sheet.draw();
  const auto middle = [&](int panel) {
    double sum = 0, count = 0;
    for (int y = 0; y < kPanelHeight - 40; ++y) {
      for (int x = 1; x < kPanelWidth; ++x) {
        if (!isSkin(picture.at(panel * kPanelWidth + x, y))) continue;
        sum += x;
        ++count;
      }
    }
    return count > 0 ? sum / count : -1;
  };
  EXPECT_GT(middle(1), middle(0) + 40);
  EXPECT_LT(countOf(picture, 2).skin, countOf(picture, 0).skin / 10) << "seen from its edge, or from behind";
}

// A small square before a large one, and the large one before the small: handed over in both orders.
TEST(Sheet, NearerSolidsHideFartherOnes) {
  const Groom groom = strands({{{0, 10, 0}, {0, 0, 0}, {0, -10, 0}}});
  const Quatd tilt = fromRotationVector(Vec3d{-0.9, 0, 0});  // lit otherwise
  const auto drawn = [&](bool smallFirst, double smallBefore) {
    const SheetSolid small = square(0.01), large = square(0.03);
    const SheetPlace smallPlace{towardsCamera(smallBefore), tilt}, largePlace{};
    Sheet sheet(groom, 1, UpAxis::y, smallFirst ? std::vector{small, large} : std::vector{large, small});
    sheet.offer(1, groom.points,
                smallFirst ? std::vector{smallPlace, largePlace} : std::vector{largePlace, smallPlace});
    return sheet.draw().pixels;
  };
  EXPECT_EQ(drawn(true, 0.04), drawn(false, 0.04));
  EXPECT_EQ(drawn(true, -0.04), drawn(false, -0.04));
  EXPECT_NE(drawn(true, 0.04), drawn(true, -0.04));
}

// The camera is for the hair: what is far from it changes nothing, what is near it is in the picture.
TEST(Sheet, SolidsThatAreFarDoNotMoveTheCamera) {
  const Groom groom = strands({{{0, 10, 0}, {0, 0, 0}, {0, -10, 0}}});
  const auto drawn = [&](Vec3d at) {
    Sheet sheet(groom, 1, UpAxis::y, {square(0.02)});
    sheet.offer(1, groom.points, std::vector<SheetPlace>{{at, {}}});
    Picture picture = sheet.draw();
    return countOf(picture);
  };
  const int all = drawn({50, 0, 0}).hair;
  EXPECT_EQ(drawn({50, 0, 0}).skin, 0);
  EXPECT_EQ(drawn({0, 300, 0}).hair, all);
  EXPECT_GT(drawn({0.03, 0, 0}).skin, 5000);
}

TEST(Sheet, KeepsPlacesInACheckpoint) {
  const Groom groom = strands({{{0, 10, 0}, {0, 0, 0}, {0, -10, 0}}});
  const auto begun = [&] {
    Sheet sheet(groom, 2, UpAxis::y, {square(0.02)});
    sheet.offer(1, groom.points, std::vector<SheetPlace>{{{0.02, 0, 0}, {}}});
    return sheet;
  };
  Sheet whole = begun(), first = begun(), second(groom, 2, UpAxis::y, {square(0.02)});
  Archive written = Archive::writing();
  first.archive(written);
  const auto bytes = written.take();
  Archive read = Archive::reading(bytes);
  second.archive(read);
  ASSERT_TRUE(read.isWhole());
  for (Sheet* sheet : {&whole, &second}) sheet->offer(2, groom.points, std::vector<SheetPlace>{{{}, {}}});
  EXPECT_EQ(whole.draw().pixels, second.draw().pixels);
}

}  // namespace
}  // namespace ringlet::sheet_test
