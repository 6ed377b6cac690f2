// hair.usda: read back by a reader that shares nothing with the writer, whole, cut short, and on a full disk.
#include "ringlet/output/usd/usd_writer.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <limits>
#include <locale>
#include <random>

#include "tests/support/strict_usd.h"
#include "tests/support/test_support.h"

namespace ringlet::usd_writer_test {
namespace {

using test::readUsd;
using test::scratchFolder;

// Strands of 2, 3, 31 and 2 particles at seeded places of every size a float has.
Groom mixedGroom() {
  Groom groom;
  std::mt19937 random(5);
  std::uniform_real_distribution<float> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-40, 40);
  for (int count : {2, 3, 31, 2}) {
    std::vector<Vec3f> strand(count);
    for (Vec3f& p : strand) {
      p = {std::ldexp(mantissa(random), exponent(random)), mantissa(random),
           std::ldexp(mantissa(random), exponent(random))};
    }
    groom.addStrand(strand);
  }
  return groom;
}

std::vector<Vec3f> moved(const Groom& groom, float by) {
  auto points = groom.points;
  for (Vec3f& p : points) p.y += by;
  return points;
}

TEST(UsdWriter, WritesEveryFrameBitForBit) {
  const auto path = scratchFolder("usd_whole") / "hair.usda";
  const Groom groom = mixedGroom();
  auto writer = UsdWriter::create(path, groom,
                                  {.framesPerSecond = 30,
                                   .metresPerUnit = 0.00254,
                                   .up = UpAxis::z,
                                   .diameter = 0.25f,
                                   .frameCount = 48});
  ASSERT_TRUE(writer) << writer.error().message;
  for (int frame = 1; frame <= 48; ++frame) {
    auto added = writer->addFrame(moved(groom, static_cast<float>(frame) / 3));
    ASSERT_TRUE(added) << added.error().message;
  }
  EXPECT_FALSE(std::filesystem::exists(path)) << "the name is for finished files";
  auto finished = writer->finish();
  ASSERT_TRUE(finished) << finished.error().message;
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".partial"));

  const auto usd = readUsd(path);
  EXPECT_EQ(usd.metadata.at("defaultPrim"), "\"Hair\"");
  EXPECT_EQ(usd.metadata.at("startTimeCode"), "1");
  EXPECT_EQ(usd.metadata.at("endTimeCode"), "48");
  EXPECT_EQ(usd.metadata.at("timeCodesPerSecond"), "30");
  EXPECT_EQ(usd.metadata.at("metersPerUnit"), "0.00254");
  EXPECT_EQ(usd.metadata.at("upAxis"), "\"Z\"");
  EXPECT_EQ(usd.tokens.at("type"), "\"linear\"");
  EXPECT_EQ(usd.tokens.at("wrap"), "\"nonperiodic\"");
  EXPECT_EQ(usd.counts, (std::vector<int>{2, 3, 31, 2}));
  EXPECT_EQ(usd.widths, std::vector<float>{0.25f});
  EXPECT_EQ(usd.widthInterpolation, "\"constant\"");
  ASSERT_EQ(usd.points.size(), 48u);
  ASSERT_EQ(usd.extent.size(), 48u);
  for (int frame = 1; frame <= 48; ++frame) {
    EXPECT_EQ(usd.points.at(frame), moved(groom, static_cast<float>(frame) / 3)) << "frame " << frame;
  }
}

TEST(UsdWriter, ExtentHoldsTheTubes) {
  const auto path = scratchFolder("usd_extent") / "hair.usda";
  Groom groom;
  groom.addStrand(std::vector<Vec3f>{{0, 0, 0}, {1, -2, 3}});
  auto writer = UsdWriter::create(path, groom, {.diameter = 0.5f, .frameCount = 1});
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->addFrame(groom.points));
  ASSERT_TRUE(writer->finish());
  EXPECT_EQ(readUsd(path).extent.at(1),
            (std::vector<Vec3f>{{-0.25f, -2.25f, -0.25f}, {1.25f, 0.25f, 3.25f}}));
}

TEST(UsdWriter, WidestNumbersFitTheirPlaces) {
  const auto path = scratchFolder("usd_wide") / "hair.usda";
  const float least = -std::numeric_limits<float>::min(), most = -1.17549435e-30f;
  Groom groom;
  groom.addStrand(std::vector<Vec3f>{{least, least, least}, {most, most, most}});
  auto writer = UsdWriter::create(path, groom, {.diameter = 1e-36f, .frameCount = 2'000'000});
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->addFrame(groom.points));
  ASSERT_TRUE(writer->finish());
  EXPECT_EQ(readUsd(path).points.at(1), groom.points);
}

TEST(UsdWriter, FewerFramesThanPlannedMakeAValidFile) {
  const auto path = scratchFolder("usd_early") / "hair.usda";
  const Groom groom = mixedGroom();
  auto writer = UsdWriter::create(path, groom, {.frameCount = 100});
  ASSERT_TRUE(writer);
  for (int frame = 1; frame <= 3; ++frame) ASSERT_TRUE(writer->addFrame(moved(groom, 1)));
  ASSERT_TRUE(writer->finish());
  const auto usd = readUsd(path);
  EXPECT_EQ(usd.metadata.at("endTimeCode"), "3");
  EXPECT_EQ(usd.points.size(), 3u);
  EXPECT_EQ(usd.extent.size(), 3u);
}

TEST(UsdWriter, IsValidAfterEveryFrame) {
  const auto path = scratchFolder("usd_partial") / "hair.usda";
  const Groom groom = mixedGroom();
  {
    auto writer = UsdWriter::create(path, groom, {.frameCount = 5});
    ASSERT_TRUE(writer);
    EXPECT_EQ(readUsd(path.string() + ".partial").points.size(), 0u);
    for (int frame = 1; frame <= 4; ++frame) {
      ASSERT_TRUE(writer->addFrame(groom.points));
      const auto usd = readUsd(path.string() + ".partial");
      EXPECT_EQ(usd.points.size(), static_cast<std::size_t>(frame));
      EXPECT_EQ(usd.metadata.at("endTimeCode"), std::to_string(frame));
    }
  }
  EXPECT_TRUE(std::filesystem::exists(path.string() + ".partial")) << "frames that were finished are kept";
}

TEST(UsdWriter, LeavesNothingWithoutAFrame) {
  const auto folder = scratchFolder("usd_none");
  { ASSERT_TRUE(UsdWriter::create(folder / "hair.usda", mixedGroom(), {.frameCount = 5})); }
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST(UsdWriter, KeepsFinishedFramesWhenTheDiskIsFull) {
  const auto path = scratchFolder("usd_full") / "hair.usda";
  Groom groom;
  groom.addStrand(std::vector<Vec3f>(1000, Vec3f{1.25f, 2.5f, 3.75f}));

  // A limit on the size of a file stands in for the full disk; without the handler it would end the program.
  std::signal(SIGXFSZ, SIG_IGN);
  struct rlimit before {};
  getrlimit(RLIMIT_FSIZE, &before);
  struct rlimit small = before;
  small.rlim_cur = 60'000;
  setrlimit(RLIMIT_FSIZE, &small);
  int kept = 0;
  std::string message;
  {
    auto writer = UsdWriter::create(path, groom, {.frameCount = 10});
    ASSERT_TRUE(writer);
    for (Status added; kept < 10; ++kept) {
      added = writer->addFrame(groom.points);
      if (!added) {
        message = added.error().message;
        break;
      }
    }
    EXPECT_EQ(writer->frameCount(), kept);
  }
  setrlimit(RLIMIT_FSIZE, &before);

  ASSERT_GT(kept, 0);
  ASSERT_LT(kept, 10);
  EXPECT_NE(
      message.find("the first " + std::to_string(kept) + " frames are kept in " + path.string() + ".partial"),
      std::string::npos)
      << message;
  EXPECT_EQ(readUsd(path.string() + ".partial").points.size(), static_cast<std::size_t>(kept));
}

TEST(UsdWriter, SaysWhichFileAndWhyItCannotWrite) {
  const auto folder = scratchFolder("usd_missing");
  auto writer = UsdWriter::create(folder / "no" / "hair.usda", mixedGroom(), {});
  ASSERT_FALSE(writer);
  EXPECT_NE(writer.error().message.find((folder / "no").string()), std::string::npos)
      << writer.error().message;
  EXPECT_NE(writer.error().message.find("No such file"), std::string::npos) << writer.error().message;
}

TEST(UsdWriter, DecimalPointWhateverTheLocale) {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const auto path = scratchFolder("usd_locale") / "hair.usda";
  const Groom groom = mixedGroom();
  const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
  auto writer = UsdWriter::create(path, groom, {.framesPerSecond = 23.976, .frameCount = 1});
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->addFrame(groom.points));
  ASSERT_TRUE(writer->finish());
  std::locale::global(before);
  const auto usd = readUsd(path);
  EXPECT_EQ(usd.metadata.at("timeCodesPerSecond"), "23.976");
  EXPECT_EQ(usd.points.at(1), groom.points);
}

}  // namespace
}  // namespace ringlet::usd_writer_test
