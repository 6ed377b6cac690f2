// groom/usd/usdz_file.h: the first layer of a package, and packages that say two things.
#include "ringlet/groom/usd/usdz_file.h"

#include <gtest/gtest.h>

#include <string>

#include "ringlet/groom/groom_file.h"
#include "ringlet/groom/usd/usd_file.h"
#include "tests/groom/crate_bytes.h"
#include "tests/groom/groom_samples.h"
#include "tests/groom/usda_samples.h"
#include "tests/groom/zip_bytes.h"
#include "tests/support/test_support.h"

namespace ringlet::usdz_file_test {
namespace {

using test::ZipBytes;

Result<LoadedGroom> read(const std::string& bytes) { return readUsd(test::bytesOf(bytes), "test.usdz"); }

void expectError(const ZipBytes& zip, const std::string& part) {
  const auto loaded = read(zip.bytes());
  ASSERT_FALSE(loaded) << "expected an error with '" << part << "'";
  EXPECT_TRUE(test::contains(loaded.error().message, "test.usdz: at byte")) << loaded.error().message;
  EXPECT_TRUE(test::contains(loaded.error().message, part)) << part << " in\n" << loaded.error().message;
}

TEST(UsdzFile, ReadsItsFirstLayer) {
  const std::string text = test::curves(test::kTwoStrands), crate = test::CrateBytes::small().bytes();
  for (const std::string& layer : {text, crate}) {
    const auto loaded = read(ZipBytes{.content = layer}.bytes());
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->groom.points, read(layer)->groom.points);
  }
  // With a picture behind it, an odd place, and a comment.
  const auto loaded =
      read(ZipBytes{.extra = std::string(37, '\0'), .content = text, .others = 3, .comment = "PK"}.bytes());
  ASSERT_TRUE(loaded) << loaded.error().message;
  const auto folder = test::scratchFolder("usdz");
  test::writeText(folder / "a.usdz", ZipBytes{.content = text}.bytes());
  EXPECT_TRUE(readGroom(folder / "a.usdz"));
}

TEST(UsdzFile, RefusesPackagesThatAreNone) {
  const std::string text = test::curves(test::kTwoStrands);
  expectError({.content = text, .method = 8}, "packed");
  expectError({.content = text, .flags = 1}, "an encrypted file");
  expectError({.content = text, .flags = 8}, "without its size");
  expectError({.name = "a.png", .content = text}, "a layer first");
  expectError({.content = text, .nameInDirectory = "b.usda"}, "both to say the same");
  expectError({.content = text, .sizeInDirectory = 3}, "both to say the same");
  for (const std::uint32_t lie : {std::uint32_t(text.size() + 1), 0x80000000u, 0xffffffffu})
    expectError({.content = text, .sizeInBoth = lie}, "beyond the directory");
  expectError({.content = text, .begin = 7}, "the file at byte 0");
}

TEST(UsdzFile, RefusesEveryTruncationAndSurvivesEveryByte) {
  const std::string whole = ZipBytes{.content = test::curves(test::kTwoStrands), .others = 1}.bytes();
  ASSERT_TRUE(read(whole));
  for (std::size_t size = 0; size < whole.size(); ++size) EXPECT_FALSE(read(whole.substr(0, size))) << size;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int change : {0x01, 0x80, 0xff}) {
      std::string bytes = whole;
      bytes[at] = static_cast<char>(bytes[at] ^ change);
      const auto loaded = read(bytes);
      if (loaded) {
        ASSERT_TRUE(test::isUsable(loaded->groom)) << at;
      }
    }
  }
}

}  // namespace
}  // namespace ringlet::usdz_file_test
