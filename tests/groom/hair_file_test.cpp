// groom/hair_file.h: every bit comes back, every broken file is refused with its byte offset, and nothing
// crashes.
#include "ringlet/groom/hair_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "ringlet/groom/groom_file.h"
#include "ringlet/output/groom_writer.h"
#include "tests/groom/groom_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::hair_file_test {
namespace {

using test::contains;

// A .hair file field by field, written independently of writeHair; the tests below spoil one field each.
struct HairBytes {
  std::uint32_t strandCount = 3, pointCount = 9, flags = 3, defaultSegments = 0;
  std::vector<std::uint16_t> segments = {1, 2, 3};
  std::vector<float> points = std::vector<float>(27, 0.5f);
  std::string after{};  // thickness and so on, and what does not belong there

  std::string bytes() const {
    std::string out = "HAIR";
    auto append = [&](const auto& value) { out.append(reinterpret_cast<const char*>(&value), sizeof value); };
    for (std::uint32_t value : {strandCount, pointCount, flags, defaultSegments}) append(value);
    for (float value : {1.f, 0.f, 1.f, 1.f, 1.f}) append(value);
    out.resize(128, '\xaa');  // text without a NUL
    for (std::uint16_t value : segments) append(value);
    for (float value : points) append(value);
    return out + after;
  }
};

Result<LoadedGroom> read(const std::string& bytes) { return readHair(test::bytesOf(bytes), "test.hair"); }
Result<LoadedGroom> read(const HairBytes& hair) { return read(hair.bytes()); }

void expectError(const std::string& bytes, const std::vector<std::string>& parts) {
  const Result<LoadedGroom> loaded = read(bytes);
  ASSERT_FALSE(loaded) << "expected an error with '" << parts.front() << "'";
  EXPECT_TRUE(contains(loaded.error().message, "test.hair")) << loaded.error().message;
  for (const std::string& part : parts)
    EXPECT_TRUE(contains(loaded.error().message, part)) << loaded.error().message;
}
void expectError(const HairBytes& hair, const std::vector<std::string>& parts) {
  expectError(hair.bytes(), parts);
}

TEST(HairFile, ReadsStrandsOfDifferentLengths) {
  HairBytes hair;
  for (std::size_t i = 0; i < 27; ++i) hair.points[i] = static_cast<float>(i);
  const Result<LoadedGroom> loaded = read(hair);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(loaded->warnings.empty());
  EXPECT_EQ(loaded->groom.firstPoint, (std::vector<std::uint32_t>{0, 2, 5, 9}));
  for (std::size_t i = 0; i < 9; ++i) {
    const float x = static_cast<float>(3 * i);
    EXPECT_EQ(loaded->groom.points[i], (Vec3f{x, x + 1, x + 2})) << "point " << i;
  }
}

// Behind thickness and transparency, without those of a strand that is left out.
TEST(HairFile, ColoursAreAPrimvar) {
  const auto floats = [](std::size_t count, float first) {
    std::string out;
    for (std::size_t i = 0; i < count; ++i) {
      const float value = first + static_cast<float>(i);
      out.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    return out;
  };
  HairBytes hair{.segments = {1, 0, 5}};
  hair.flags = 3 | 4 | 8 | 16;
  hair.after = floats(9, 100) + floats(9, 200) + floats(27, 0);
  const auto read = [&] { return readHair(test::bytesOf(hair.bytes()), "test.hair", {.keepsPrims = true}); };
  auto loaded = read();
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->prims.size(), 1u);
  EXPECT_EQ(loaded->prims[0].strandCount, 2u);
  ASSERT_EQ(loaded->prims[0].values.size(), 1u);
  const GroomValue& colours = loaded->prims[0].values[0];
  EXPECT_EQ(colours.name, "primvars:displayColor");
  EXPECT_EQ(colours.interpolation, "vertex");
  std::vector<double> expected{0, 1, 2, 3, 4, 5};
  for (int i = 9; i < 27; ++i) expected.push_back(i);
  EXPECT_EQ(colours.numbers, expected);
  EXPECT_TRUE(readHair(test::bytesOf(hair.bytes()), "test.hair")->prims.empty());

  const float nothing = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(hair.after.data() + 72, &nothing, 4);
  loaded = read();
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(loaded->prims.empty());
  ASSERT_EQ(loaded->warnings.size(), 2u);
  EXPECT_TRUE(contains(loaded->warnings[1], "a colour that is not finite")) << loaded->warnings[1];
}

TEST(HairFile, TakesALowerCaseMagicWithAWarning) {
  std::string bytes = HairBytes{}.bytes();
  bytes.replace(0, 4, "hair");
  const Result<LoadedGroom> loaded = read(bytes);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->groom.points, read(HairBytes{})->groom.points);
  ASSERT_EQ(loaded->warnings.size(), 1u);
  EXPECT_TRUE(contains(loaded->warnings[0], "found 'hair' for 'HAIR'; read as the same"))
      << loaded->warnings[0];
  bytes.replace(0, 4, "Hair");
  expectError(bytes, {"at byte 0: found 'Hair'; expected 'HAIR'"});
}

TEST(HairFile, ReadsFilesWithoutSegmentsArray) {
  const HairBytes hair{.flags = 2, .defaultSegments = 2, .segments = {}};
  const Result<LoadedGroom> loaded = read(hair);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->groom.firstPoint, (std::vector<std::uint32_t>{0, 3, 6, 9}));
}

TEST(HairFile, StepsOverThicknessTransparencyAndColours) {
  for (std::uint32_t flags = 0; flags < 8; ++flags) {
    const std::size_t perPoint = (flags & 1 ? 4u : 0u) + (flags & 2 ? 4u : 0u) + (flags & 4 ? 12u : 0u);
    HairBytes hair{.flags = 3 | flags << 2, .after = std::string(9 * perPoint, '\xff')};
    const Result<LoadedGroom> loaded = read(hair);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(loaded->warnings.empty());
    EXPECT_EQ(loaded->groom.strandCount(), 3u);
    if (hair.after.empty()) continue;
    hair.after.pop_back();
    expectError(hair, {"at byte 4", "the file ends at byte"});
  }
}

TEST(HairFile, WritesWhatItReads) {
  const auto folder = test::scratchFolder("hair_file");
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const Groom groom = seed == 0 ? test::awkwardGroom() : test::randomGroom(seed, 1 + 7 * int(seed));
    ASSERT_TRUE(writeGroom(folder / "a.hair", groom));
    const Result<LoadedGroom> loaded = readGroom(folder / "a.hair");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(loaded->warnings.empty());
    EXPECT_TRUE(test::hasSameBits(loaded->groom, groom)) << "seed " << seed;
  }
  EXPECT_EQ(test::fileCount(folder), 1);
}

TEST(HairFile, WritesTheHeaderTheFormatAsksFor) {
  const auto folder = test::scratchFolder("hair_header");
  ASSERT_TRUE(writeHair(folder / "a.hair", test::awkwardGroom()));
  const std::string bytes = test::readText(folder / "a.hair");
  ASSERT_EQ(bytes.size(), 128u + 2 * 3 + 12 * 9);
  HairBytes expected;
  EXPECT_EQ(bytes.substr(0, 40), expected.bytes().substr(0, 40));
  EXPECT_EQ(bytes.substr(128, 6), std::string("\1\0\2\0\3\0", 6));
}

TEST(HairFile, WritesAtMost65535Segments) {
  const auto folder = test::scratchFolder("hair_long");
  Groom groom;
  groom.addStrand(std::vector<Vec3f>(65536, Vec3f{1, 2, 3}));
  ASSERT_TRUE(writeHair(folder / "a.hair", groom));
  const Result<LoadedGroom> loaded = readGroom(folder / "a.hair");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(test::hasSameBits(loaded->groom, groom));

  Groom tooLong;
  tooLong.addStrand(std::vector<Vec3f>(2));
  tooLong.addStrand(std::vector<Vec3f>(65537));
  const Status status = writeHair(folder / "b.hair", tooLong);
  ASSERT_FALSE(status);
  EXPECT_TRUE(contains(status.error().message, "strand 1 has 65536 segments")) << status.error().message;
  EXPECT_EQ(test::fileCount(folder), 1);
}

TEST(HairFile, RefusesEveryTruncation) {
  const std::string whole = HairBytes{.flags = 31, .after = std::string(9 * 20, '\0')}.bytes();
  ASSERT_TRUE(read(whole));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    expectError(whole.substr(0, size),
                {size < 128 ? "at byte " + std::to_string(size) : "ends at byte " + std::to_string(size)});
  }
}

TEST(HairFile, RefusesAWrongHeader) {
  std::string wrongMagic = HairBytes{}.bytes();
  wrongMagic[3] = '\n';
  expectError(wrongMagic, {"at byte 0", "'HAI\\x0a'", "expected 'HAIR'"});
  expectError(HairBytes{.flags = 1}, {"at byte 12", "0x1", "expected bit 1"});
  expectError(HairBytes{.flags = 0}, {"at byte 12"});
  expectError(HairBytes{.strandCount = 0, .pointCount = 0, .segments = {}, .points = {}},
              {"at byte 4", "0 strands"});
}

TEST(HairFile, RefusesCountsThatLie) {
  for (std::uint32_t lie : {10u, 1000u, 0x7fffffffu, 0x80000000u, 0xfffffffeu, 0xffffffffu}) {
    expectError(HairBytes{.strandCount = lie}, {"at byte 4", std::to_string(lie)});
    expectError(HairBytes{.pointCount = lie}, {"at byte 4", std::to_string(lie)});
    expectError(HairBytes{.strandCount = lie, .pointCount = lie}, {"at byte 4"});
    expectError(HairBytes{.strandCount = lie, .flags = 2}, {"at byte 8", "found 9 points"});
    expectError(HairBytes{.flags = 2, .defaultSegments = lie}, {"at byte 8", std::to_string(lie)});
    // The product wraps around 32 bits to what the file holds.
    expectError(HairBytes{.strandCount = lie, .flags = 2, .defaultSegments = lie}, {"at byte 8"});
  }
  // 2^31 strands of 2^1 points are 2^32: 0 when cut to 32 bits.
  expectError(HairBytes{.strandCount = 0x80000000u, .pointCount = 0, .flags = 2, .defaultSegments = 1},
              {"at byte 8"});
}

TEST(HairFile, RefusesSegmentsThatDoNotAddUp) {
  expectError(HairBytes{.segments = {1, 2, 2}}, {"at byte 8", "found 9 points", "expected 8"});
  expectError(HairBytes{.segments = {1, 3, 3}}, {"at byte 132", "strand 2", "10 points", "expected 9"});
  expectError(HairBytes{.segments = {65535, 65535, 65535}}, {"at byte 128", "65535 segments", "strand 0"});
}

TEST(HairFile, LeavesOutStrandsWithPointsThatAreNotFinite) {
  for (float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                    -std::numeric_limits<float>::infinity()}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      HairBytes hair;
      hair.points[3 * 4 + axis] = bad;  // the last point of the second strand
      const Result<LoadedGroom> loaded = read(hair);
      ASSERT_TRUE(loaded) << loaded.error().message;
      EXPECT_EQ(loaded->groom.firstPoint, (std::vector<std::uint32_t>{0, 2, 6}));
      ASSERT_EQ(loaded->warnings.size(), 1u);
      for (const char* part : {"left out 1 of 3 strands", "at byte 182", "strand 1, point 2", "finite"})
        EXPECT_TRUE(contains(loaded->warnings[0], part)) << loaded->warnings[0];
      for (std::size_t point : {1, 5}) hair.points[3 * point + axis] = bad;
      expectError(hair, {"strand 0, point 1", "finite"});
    }
  }
}

TEST(HairFile, LeavesOutStrandsOfOnePoint) {
  HairBytes hair{.strandCount = 4, .pointCount = 9, .segments = {0, 2, 0, 3}};
  for (std::size_t i = 0; i < 27; ++i) hair.points[i] = static_cast<float>(i / 3);
  const Result<LoadedGroom> loaded = read(hair);
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->warnings.size(), 1u);
  EXPECT_TRUE(contains(loaded->warnings[0], "left out 2 of 4 strands")) << loaded->warnings[0];
  EXPECT_EQ(loaded->groom.firstPoint, (std::vector<std::uint32_t>{0, 3, 7}));
  EXPECT_EQ(loaded->groom.points[0].x, 1);
  EXPECT_EQ(loaded->groom.points[3].x, 5);

  expectError(HairBytes{.strandCount = 9, .segments = std::vector<std::uint16_t>(9, 0)},
              {"none of the 9 strands"});
  expectError(HairBytes{.strandCount = 9, .flags = 2, .segments = {}}, {"none of the 9 strands"});
}

TEST(HairFile, WarnsOfUnknownFlagsAndTrailingBytes) {
  const Result<LoadedGroom> loaded = read(HairBytes{.flags = 0x23, .after = "uv"});
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->groom.strandCount(), 3u);
  ASSERT_EQ(loaded->warnings.size(), 2u);
  EXPECT_TRUE(contains(loaded->warnings[0], "unknown bits 0x20")) << loaded->warnings[0];
  EXPECT_TRUE(contains(loaded->warnings[1], "2 bytes after the last array, from byte 242"))
      << loaded->warnings[1];
}

TEST(HairFile, ReadsRealHair) {
  RINGLET_NEEDS_DATA(path, "hair/straight.hair");
  const Result<LoadedGroom> loaded = readGroom(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(loaded->warnings.empty());
  EXPECT_EQ(loaded->groom.strandCount(), 10000u);
  EXPECT_EQ(loaded->groom.points.size(), 160000u);
  // Its first point, as the bytes at 128 say: 85ff11bf 41b5d8bf 34886e42.
  const Vec3f first = loaded->groom.points[0];
  EXPECT_EQ(first, (Vec3f{-0.570305169f, -1.69303143f, 59.6330109f}));
}

}  // namespace
}  // namespace ringlet::hair_file_test
