// groom/tfx_file.h: the positions come out as they stand in the file, what fills up the count is left out,
// and every broken file is refused with its byte offset.
#include "ringlet/groom/tfx_file.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "ringlet/groom/groom_file.h"
#include "ringlet/output/groom_writer.h"
#include "tests/groom/groom_samples.h"
#include "tests/groom/tfx_bytes.h"
#include "tests/support/test_support.h"

namespace ringlet::tfx_file_test {
namespace {

using test::contains;
using test::TfxBytes;

Result<LoadedGroom> read(const std::string& bytes) { return readTfx(test::bytesOf(bytes), "test.tfx"); }
Result<LoadedGroom> read(const TfxBytes& tfx) { return read(tfx.bytes()); }

void expectError(const std::string& bytes, const std::vector<std::string>& parts) {
  const Result<LoadedGroom> loaded = read(bytes);
  ASSERT_FALSE(loaded) << "expected an error with '" << parts.front() << "'";
  EXPECT_TRUE(contains(loaded.error().message, "test.tfx")) << loaded.error().message;
  for (const std::string& part : parts)
    EXPECT_TRUE(contains(loaded.error().message, part)) << loaded.error().message;
}
void expectError(const TfxBytes& tfx, const std::vector<std::string>& parts) {
  expectError(tfx.bytes(), parts);
}

TEST(TfxFile, ReadsPositionsStrandByStrand) {
  const TfxBytes tfx;
  const Result<LoadedGroom> loaded = read(tfx);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(loaded->warnings.empty());
  EXPECT_EQ(loaded->groom.firstPoint, (std::vector<std::uint32_t>{0, 4, 8, 12}));
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(loaded->groom.points[i],
              (Vec3f{tfx.positions[4 * i], tfx.positions[4 * i + 1], tfx.positions[4 * i + 2]}))
        << "point " << i;
  }
}

TEST(TfxFile, FindsPositionsWhereverTheyAre) {
  // Behind another array, and at an odd byte, which AMD does not write but nothing forbids.
  for (std::uint32_t offset : {161u, 168u, 1000u}) {
    const Result<LoadedGroom> loaded = read(TfxBytes{.positionsOffset = offset, .otherOffsets = {160}});
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(loaded->warnings.empty());
    EXPECT_EQ(loaded->groom.points, read(TfxBytes{})->groom.points);
  }
}

TEST(TfxFile, TakesAnyNumberOfPointsFromTwoTo65536) {
  for (std::uint32_t count : {2u, 3u, 64u, 100u, 65536u}) {
    const Result<LoadedGroom> loaded = read(TfxBytes::uniform(2, count));
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->groom.firstPoint, (std::vector<std::uint32_t>{0, count, 2 * count}));
  }
  expectError(TfxBytes::uniform(2, 65537), {"at byte 8", "found 65537 points", "2 to 65536"});
  expectError(TfxBytes::uniform(2, 1), {"at byte 8", "found 1 points"});
}

TEST(TfxFile, LeavesOutWhatFillsUpTheCount) {
  TfxBytes tfx = TfxBytes::uniform(64, 4);
  // The second of all strands and the last three have no length; w does not matter.
  for (std::size_t s : {1u, 61u, 62u, 63u}) {
    for (std::size_t i = 0; i < 16; ++i) tfx.positions[16 * s + i] = i % 4 == 3 ? float(i) : 0.25f;
  }
  const Result<LoadedGroom> loaded = read(tfx);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->groom.strandCount(), 61u);
  EXPECT_TRUE(test::isUsable(loaded->groom));
  ASSERT_EQ(loaded->warnings.size(), 1u);
  EXPECT_TRUE(contains(loaded->warnings[0], "the last 3 of 64 strands")) << loaded->warnings[0];

  for (float& value : tfx.positions) value = 1;
  expectError(tfx, {"each of the 64 strands", "in one place"});
}

TEST(TfxFile, RefusesEveryTruncation) {
  const std::string whole = TfxBytes{}.bytes();
  ASSERT_TRUE(read(whole));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    expectError(whole.substr(0, size),
                {size < 160 ? "at byte " + std::to_string(size) : "ends at byte " + std::to_string(size)});
  }
}

TEST(TfxFile, RefusesOtherVersionsAndWarnsOfLaterFours) {
  for (float version : {0.f, 3.f, 3.99f, 5.f, -4.f, 1e30f, std::numeric_limits<float>::quiet_NaN(),
                        std::numeric_limits<float>::infinity()}) {
    expectError(TfxBytes{.version = version}, {"at byte 0", "found version", "expected 4.0"});
  }
  const Result<LoadedGroom> loaded = read(TfxBytes{.version = 4.5f});
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->warnings.size(), 1u);
  EXPECT_TRUE(contains(loaded->warnings[0], "found version 4.5")) << loaded->warnings[0];
}

TEST(TfxFile, RefusesCountsThatLie) {
  expectError(TfxBytes{.strandCount = 0}, {"at byte 4", "0 strands"});
  expectError(TfxBytes{.pointsPerStrand = 0}, {"at byte 8", "found 0 points"});
  for (std::uint32_t lie : {4u, 1000u, 0x10000000u, 0x7fffffffu, 0x80000000u, 0xffffffffu}) {
    expectError(TfxBytes{.strandCount = lie},
                {"at byte 4", std::to_string(lie), "the file ends at byte 352"});
    // Products of the two that wrap around 32 bits.
    expectError(TfxBytes{.strandCount = lie, .pointsPerStrand = 65536}, {"at byte 4", std::to_string(lie)});
  }
  for (std::uint32_t lie : {5u, 65536u}) expectError(TfxBytes{.pointsPerStrand = lie}, {"at byte 4"});
  for (std::uint32_t lie : {65537u, 0x40000000u, 0xffffffffu})
    expectError(TfxBytes{.pointsPerStrand = lie}, {"at byte 8", std::to_string(lie)});
}

TEST(TfxFile, RefusesPositionsOutsideTheFile) {
  for (std::uint32_t offset : {0u, 12u, 159u}) {
    std::string bytes = TfxBytes{}.bytes();
    TfxBytes::setU32(bytes, 12, offset);
    expectError(bytes, {"at byte 12", "positions at byte " + std::to_string(offset), "160 or later"});
  }
  for (std::uint32_t offset : {161u, 352u, 0x80000000u, 0xffffffffu}) {
    std::string bytes = TfxBytes{}.bytes();
    TfxBytes::setU32(bytes, 12, offset);
    expectError(bytes, {"positions at byte " + std::to_string(offset), "the file ends at byte 352"});
  }
}

TEST(TfxFile, RefusesPointsThatAreNotFinite) {
  for (float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                    -std::numeric_limits<float>::infinity()}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      TfxBytes tfx = TfxBytes::uniform(1, 8);  // beside others: left_out_test.cpp
      tfx.positions[4 * 6 + axis] = bad;
      expectError(tfx, {"at byte 256", "strand 0, point 6", "finite"});
    }
    TfxBytes tfx;
    tfx.positions[4 * 6 + 3] = bad;  // w is not ours
    EXPECT_TRUE(read(tfx));
  }
}

TEST(TfxFile, WarnsOfTrailingBytesThatNoArrayOwns) {
  const Result<LoadedGroom> loaded = read(TfxBytes{.after = "uv"});
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->warnings.size(), 1u);
  EXPECT_TRUE(contains(loaded->warnings[0], "2 bytes after the last array, from byte 352"))
      << loaded->warnings[0];
  const Result<LoadedGroom> owned = read(TfxBytes{.otherOffsets = {0, 0, 0, 352}, .after = "uv"});
  ASSERT_TRUE(owned) << owned.error().message;
  EXPECT_TRUE(owned->warnings.empty());
}

TEST(TfxFile, IsChosenByExtensionAndReadOnly) {
  const auto folder = test::scratchFolder("tfx_file");
  test::writeText(folder / "a.TFX", TfxBytes{}.bytes());
  const Result<LoadedGroom> loaded = readGroom(folder / "a.TFX");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->groom.strandCount(), 3u);

  const Status status = writeGroom(folder / "b.tfx", loaded->groom);
  ASSERT_FALSE(status);
  EXPECT_TRUE(contains(status.error().message, ".tfx is only read; supported are .hair, .obj"))
      << status.error().message;
  EXPECT_EQ(test::fileCount(folder), 1);
}

TEST(TfxFile, ReadsRealHair) {
  RINGLET_NEEDS_DATA(path, "sintel/GEO-sintel_hair_emit.002-sintel_hair.tfx");
  const Result<LoadedGroom> loaded = readGroom(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(loaded->warnings.empty());
  EXPECT_EQ(loaded->groom.strandCount(), 228u);
  EXPECT_EQ(loaded->groom.points.size(), 228u * 32);
  // The first and the last position, as `od -A d -t f4` shows the bytes at 160 and at 116880.
  EXPECT_EQ(loaded->groom.points.front(), (Vec3f{-8.18532181f, 35.2255325f, -2.39242458f}));
  EXPECT_EQ(loaded->groom.points.back(), (Vec3f{5.60952759f, 21.3069134f, -1.08232892f}));
}

}  // namespace
}  // namespace ringlet::tfx_file_test
