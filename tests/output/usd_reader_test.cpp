// output/usd/usd_reader.h: reads what UsdWriter writes, bit for bit, finished or not, and refuses anything
// else.
#include "ringlet/output/usd/usd_reader.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <random>

#include "ringlet/output/usd/usd_writer.h"
#include "tests/support/memory_limit.h"
#include "tests/support/test_support.h"

namespace ringlet::usd_reader_test {
namespace {

using test::readText;
using test::scratchFolder;

// Strands of 2, 3 and 31 particles, at places of every size a float has.
Groom mixedGroom(std::uint32_t seed) {
  Groom groom;
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-140, 120);
  for (std::size_t count : {2, 3, 31}) {
    std::vector<Vec3f> strand(count);
    for (Vec3f& p : strand)
      p = {std::ldexp(mantissa(random), exponent(random)), mantissa(random), 1e3f * mantissa(random)};
    groom.addStrand(strand);
  }
  return groom;
}

// Writes frames of seeds 1, 2, ... and leaves the file unfinished or not.
void write(const std::filesystem::path& path, int frames, int announced, bool finish) {
  auto writer = UsdWriter::create(
      path, mixedGroom(1),
      {.framesPerSecond = 23.976, .metresPerUnit = 0.0254, .up = UpAxis::z, .frameCount = announced});
  ASSERT_TRUE(writer) << writer.error().message;
  for (int frame = 1; frame <= frames; ++frame)
    ASSERT_TRUE(writer->addFrame(mixedGroom(static_cast<std::uint32_t>(frame)).points));
  if (finish) {
    ASSERT_TRUE(writer->finish());
  }
}

// All that reading the file says: "" if it reads well to its end.
std::string errorOf(const std::filesystem::path& path) {
  auto reader = UsdReader::open(path);
  if (!reader) return reader.error().message;
  std::vector<Vec3f> points;
  for (;;) {
    auto more = reader->readFrame(points);
    if (!more) return more.error().message;
    if (!*more) return "";
  }
}

TEST(UsdReader, ReadsEveryFrameBitForBit) {
  const auto folder = scratchFolder("usd_reader");
  write(folder / "hair.usda", 7, 7, true);
  write(folder / "cut.usda", 7, 100, false);
  for (const char* name : {"hair.usda", "cut.usda.partial"}) {
    auto reader = UsdReader::open(folder / name);
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_EQ(reader->frameCount(), 7);
    EXPECT_EQ(reader->framesPerSecond(), 23.976);
    EXPECT_EQ(reader->metresPerUnit(), 0.0254);
    EXPECT_EQ(reader->up(), UpAxis::z);
    EXPECT_EQ(reader->particleCounts(), (std::vector<std::uint32_t>{2, 3, 31}));
    std::vector<Vec3f> points;
    for (std::uint32_t frame = 1; frame <= 7; ++frame) {
      auto more = reader->readFrame(points);
      ASSERT_TRUE(more) << more.error().message;
      ASSERT_TRUE(*more);
      const Groom expected = mixedGroom(frame);
      ASSERT_EQ(points.size(), expected.points.size());
      EXPECT_EQ(std::memcmp(points.data(), expected.points.data(), points.size() * sizeof(Vec3f)), 0);
    }
    for (int again = 0; again < 2; ++again) {
      auto more = reader->readFrame(points);
      ASSERT_TRUE(more) << more.error().message;
      EXPECT_FALSE(*more);
    }
  }
}

TEST(UsdReader, ReadsFilesLargerThanItsBuffer) {
  const auto folder = scratchFolder("usd_reader_large");
  Groom groom;
  for (int s = 0; s < 50; ++s)
    groom.addStrand(std::vector<Vec3f>(100, Vec3f{1.23456789f, -9.87654321f, 0.1f}));
  auto writer = UsdWriter::create(folder / "hair.usda", groom, {.frameCount = 5});
  ASSERT_TRUE(writer);
  for (int frame = 0; frame < 5; ++frame) ASSERT_TRUE(writer->addFrame(groom.points));
  ASSERT_TRUE(writer->finish());
  EXPECT_EQ(errorOf(folder / "hair.usda"), "");
}

TEST(UsdReader, RefusesAnythingElse) {
  const auto folder = scratchFolder("usd_reader_broken");
  write(folder / "hair.usda", 2, 2, true);
  const std::string whole = readText(folder / "hair.usda");
  auto errorOfText = [&](const std::string& text) {
    std::ofstream(folder / "broken.usda", std::ios::binary) << text;
    return errorOf(folder / "broken.usda");
  };
  ASSERT_EQ(errorOfText(whole), "");

  // Cut anywhere. What is cut is said, and nothing crashes; only the last line break is not missed.
  for (std::size_t size = 0; size + 1 < whole.size(); size += 7)
    EXPECT_NE(errorOfText(whole.substr(0, size)), "") << size;

  auto replaced = [&](const std::string& what, const std::string& by) {
    const std::size_t at = whole.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return whole.substr(0, at) + by + whole.substr(at + what.size());
  };
  EXPECT_NE(errorOfText(replaced("#usda", "#usdc")), "");
  EXPECT_NE(errorOfText(replaced("BasisCurves", "Mesh")), "");
  EXPECT_NE(errorOfText(replaced("linear", "cubic")), "");
  EXPECT_NE(errorOfText(replaced("metersPerUnit = 0.0254", "metersPerUnit = 0")), "");
  EXPECT_NE(errorOfText(replaced("endTimeCode = 2", "endTimeCode = 3")), "");
  EXPECT_NE(errorOfText(replaced("[2, 3, 31]", "[2, 3, 32]")), "");
  EXPECT_NE(errorOfText(replaced("[2, 3, 31]", "[2, 3, 1.5]")), "");
  const std::size_t points = whole.find("points.timeSamples");
  std::string later = whole;
  later.replace(whole.find("2: [", points), 1, "3");
  EXPECT_NE(errorOfText(later), "");
  const std::size_t number = whole.find('(', points) + 1;
  for (const char* bad : {"nan", "inf", "1e99", "", "1,2", "0x1"}) {
    const std::string text = whole.substr(0, number) + bad + whole.substr(whole.find(',', number));
    EXPECT_NE(errorOfText(text), "") << bad;
  }
  EXPECT_NE(errorOfText(whole + "def Mesh {}"), "");
  EXPECT_NE(errorOf(folder / "missing.usda"), "");
  EXPECT_NE(errorOf(folder), "");
}

// A file of some kilobytes that speaks of a thousand million particles.
TEST(UsdReader, MemoryIsTakenForPointsThatAreThere) {
  const auto path = scratchFolder("usd_reader_memory") / "hair.usda";
  write(path, 1, 1, true);
  std::string text = readText(path);
  const std::string counts = "[2, 3, 31]";
  const std::size_t at = text.find(counts);
  ASSERT_NE(at, std::string::npos);
  std::ofstream(path, std::ios::binary) << text.replace(at, counts.size(), "[2, 3, 1000000000]");
  const test::MemoryLimit limit(256u << 20);
  EXPECT_NE(errorOf(path).find("expected '(', found ']"), std::string::npos) << errorOf(path);
}

}  // namespace
}  // namespace ringlet::usd_reader_test
