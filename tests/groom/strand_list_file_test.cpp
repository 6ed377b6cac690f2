// groom/strand_list_file.h: .data and .bin, strands that stand for none, and every broken file.
#include "ringlet/groom/strand_list_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>

#include "ringlet/groom/groom_file.h"
#include "tests/groom/groom_samples.h"
#include "tests/groom/strand_list_bytes.h"
#include "tests/support/memory_limit.h"
#include "tests/support/test_support.h"

namespace ringlet::strand_list_file_test {
namespace {

using test::contains;
using test::strandList;

// Both formats, by the numbers of a point.
Result<LoadedGroom> read(const std::string& bytes, int floats) {
  return floats == 3 ? readStrandData(test::bytesOf(bytes), "test.data")
                     : readStrandBin(test::bytesOf(bytes), "test.bin");
}
void expectError(const std::string& bytes, int floats, const std::string& part) {
  const auto loaded = read(bytes, floats);
  ASSERT_FALSE(loaded) << "expected an error with '" << part << "'";
  EXPECT_TRUE(contains(loaded.error().message, floats == 3 ? "test.data" : "test.bin"));
  EXPECT_TRUE(contains(loaded.error().message, part)) << part << " in\n" << loaded.error().message;
}

TEST(StrandListFile, ReadsStrands) {
  for (const int floats : {3, 7}) {
    const auto loaded = read(strandList({3, 2}, floats), floats);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(loaded->warnings.empty());
    EXPECT_EQ(loaded->groom.points,
              (std::vector<Vec3f>{{0, 0, 0.5f}, {0, 1, 0.5f}, {0, 2, 0.5f}, {1, 0, 0.5f}, {1, 1, 0.5f}}));
  }
}

TEST(StrandListFile, LeavesOutStrandsThatStandForNone) {
  for (const int floats : {3, 7}) {
    const auto loaded = read(strandList({1, 2, 1, 0, 3}, floats), floats);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->groom.firstPoint, (std::vector<std::uint32_t>{0, 2, 5}));
    EXPECT_EQ(loaded->groom.points[0].x, 1);
    ASSERT_EQ(loaded->warnings.size(), 1u);
    EXPECT_TRUE(contains(loaded->warnings[0], "left out 3 of 5 strands")) << loaded->warnings[0];
    expectError(strandList({1, 1}, floats), floats, "none of the 2 strands has two points");
  }
}

TEST(StrandListFile, RefusesEveryTruncation) {
  for (const int floats : {3, 7}) {
    const std::string whole = strandList({3, 1, 2}, floats);
    ASSERT_TRUE(read(whole, floats));
    for (std::size_t size = 0; size < whole.size(); ++size)
      expectError(whole.substr(0, size), floats, "the file ends at byte " + std::to_string(size));
    const auto longer = read(whole + "xy", floats);
    ASSERT_TRUE(longer);
    EXPECT_TRUE(contains(longer->warnings.back(), "2 bytes after the last strand"));
  }
}

TEST(StrandListFile, RefusesCountsAndNumbersThatLie) {
  const test::MemoryLimit limit(256u << 20);
  for (const int floats : {3, 7}) {
    const std::string whole = strandList({3, 2}, floats);
    for (const std::uint32_t lie : {0u, 3u, 100u, 0x40000000u, 0x7fffffffu, 0x80000000u, 0xffffffffu}) {
      for (const std::size_t at : {std::size_t{0}, std::size_t{4}}) {
        if (at == 4 && (lie == 0 || lie == 3)) continue;
        std::string bytes = whole;
        std::memcpy(bytes.data() + at, &lie, 4);
        EXPECT_FALSE(read(bytes, floats)) << lie;
      }
    }
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
      std::string bytes = strandList({3}, floats);  // beside others: left_out_test.cpp
      std::memcpy(bytes.data() + 8 + 4 * floats, &bad, 4);
      expectError(bytes, floats, "strand 0, point 1; expected finite numbers");
    }
  }
  // What is none of a place may be anything.
  std::string bytes = strandList({2}, 7);
  const float bad = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(bytes.data() + 8 + 12, &bad, 4);
  EXPECT_TRUE(read(bytes, 7));
}

TEST(StrandListFile, IsChosenByExtension) {
  const auto folder = test::scratchFolder("strand_list");
  test::writeText(folder / "a.data", strandList({3}, 3));
  test::writeText(folder / "b.BIN", strandList({3}, 7));
  EXPECT_EQ(readGroom(folder / "a.data")->groom.points, readGroom(folder / "b.BIN")->groom.points);
}

}  // namespace
}  // namespace ringlet::strand_list_file_test
