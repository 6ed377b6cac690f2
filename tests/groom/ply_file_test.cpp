// groom/ply_file.h: strands by count and by edge, as text and as bytes, and every broken file.
#include "ringlet/groom/ply_file.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ringlet/groom/groom_file.h"
#include "ringlet/output/groom_writer.h"
#include "tests/groom/groom_samples.h"
#include "tests/groom/ply_samples.h"
#include "tests/support/memory_limit.h"
#include "tests/support/test_support.h"

namespace ringlet::ply_file_test {
namespace {

using test::contains;

Result<LoadedGroom> read(const std::string& bytes) { return readPly(test::bytesOf(bytes), "test.ply"); }
void expectError(const std::string& bytes, const std::vector<std::string>& parts) {
  const auto loaded = read(bytes);
  ASSERT_FALSE(loaded) << "expected an error with '" << parts.front() << "'";
  EXPECT_TRUE(contains(loaded.error().message, "test.ply")) << loaded.error().message;
  for (const std::string& part : parts)
    EXPECT_TRUE(contains(loaded.error().message, part)) << part << " in\n" << loaded.error().message;
}

const std::vector<Vec3f> kPoints{{0, 0, 0}, {0, -1, 0}, {0, -2, 0.5f}, {1, 0, 0}, {1, -1.5f, 0}};

TEST(PlyFile, ReadsStrandsByCount) {
  for (const std::string& bytes : {test::plyText(), test::plyBinary()}) {
    const auto loaded = read(bytes);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(loaded->warnings.empty());
    EXPECT_EQ(loaded->groom.firstPoint, (std::vector<std::uint32_t>{0, 3, 5}));
    EXPECT_EQ(loaded->groom.points, kPoints);
  }
}

TEST(PlyFile, ReadsStrandsByEdge) {
  const std::string text =
      "ply\r\nformat ascii 1.0\r\ncomment by hand\r\nelement face 1\r\nproperty list uchar int "
      "vertex_indices\r\n"
      "element vertex 6\r\nproperty double z\r\nproperty float x\r\nproperty uchar red\r\nproperty float "
      "y\r\n"
      "element edge 3\r\nproperty int vertex1\r\nproperty int vertex2\r\nend_header\r\n3 0 1 2\r\n0 0 255 "
      "0\r\n0 0 1 "
      "-1\r\n0.5 0 2 -2\r\n0 1 3 0\r\n0 1 4 -1.5\r\n9 9 5 9\r\n1 2\r\n0 1\r\n3 4\r\n";
  const auto loaded = read(text);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->groom.firstPoint, (std::vector<std::uint32_t>{0, 3, 5}));
  EXPECT_EQ(loaded->groom.points, kPoints);
  ASSERT_EQ(loaded->warnings.size(), 1u);
  EXPECT_TRUE(contains(loaded->warnings[0], "1 of 6 points are of no strand"));
}

TEST(PlyFile, LeavesOutStrandsOfOnePoint) {
  const auto loaded = read(test::plyText("2\n0\n0\n"));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->groom.strandCount(), 1u);
  ASSERT_EQ(loaded->warnings.size(), 1u);
  EXPECT_TRUE(contains(loaded->warnings[0], "left out 2 of 3 strands"));
  const auto fewer = read(test::plyText("2\n"));
  ASSERT_TRUE(fewer);
  EXPECT_TRUE(contains(fewer->warnings[0], "the last 2 of 5 points are of no strand"));
}

TEST(PlyFile, RefusesWhatItCannotRead) {
  expectError("", {"line 1", "expected 'ply'"});
  expectError("ply\nformat binary_big_endian 1.0\nend_header\n", {"line 2", "ascii or binary_little_endian"});
  expectError("ply\nend_header\n", {"line 2", "`format`"});
  expectError("ply\nformat ascii 1.0\nelement vertex many\nend_header\n", {"line 3", "how many"});
  expectError("ply\nformat ascii 1.0\nproperty float x\nend_header\n", {"line 3", "an element before"});
  expectError("ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n",
              {"line 4", "its type and its name"});
  expectError("ply\nformat ascii 1.0\nwhatever\n", {"line 3", "found 'whatever'"});
  expectError("ply\nformat ascii 1.0\n", {"expected 'end_header'"});
  expectError("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n",
              {"has no property y"});
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n";
  expectError(head + "end_header\n1 2 3\n4 5 6\n",
              {"found 2 points and neither an element `strand` nor `edge`"});
  expectError(head + "end_header\n1 2 3\n4 five 6\n", {"vertex 1: found no number"});
  for (const char* bad : {"nan", "1e39", "-inf"}) {
    expectError(head + "element strand 1\nproperty ushort nsegs\nend_header\n1 2 3\n4 5 " + bad + "\n1\n",
                {"vertex 1", "expected finite numbers"});
  }
  expectError(head + "element strand 1\nproperty ushort nverts\nend_header\n1 2 3\n4 5 6\n2\n",
              {"has no property nsegs"});
  expectError(test::plyText("2\n2\n"), {"have 6 points by their nsegs, and it has 5"});
  expectError(test::plyText("-1\n"), {"strand 0: found nsegs -1"});
  expectError(test::plyText("1.5\n"), {"strand 0: found nsegs 1.5"});
  const std::string edges =
      head + "element edge 2\nproperty int vertex1\nproperty int vertex2\nend_header\n1 2 3\n4 5 6\n";
  expectError(edges + "0 1\n1 2\n", {"edge 1: found point 2; expected one of 2"});
  expectError(edges + "0 1\n1 0\n", {"its edges, one a line", "closed loop"});
}

TEST(PlyFile, RefusesEveryTruncation) {
  for (const std::string& whole : {test::plyText(), test::plyBinary()}) {
    ASSERT_TRUE(read(whole));
    for (std::size_t size = 0; size + 1 < whole.size(); ++size) {
      const auto loaded = read(whole.substr(0, size));
      EXPECT_FALSE(loaded) << size;
    }
  }
}

TEST(PlyFile, RefusesCountsThatLie) {
  const test::MemoryLimit limit(256u << 20);
  for (const char* lie : {"6", "1000000", "4294967296", "18446744073709551615"}) {
    std::string text = test::plyText();
    text.replace(text.find("vertex 5"), 8, std::string("vertex ") + lie);
    expectError(text, {std::string(lie) == "6" ? "the file ends here"
                                               : std::string("expected ") + lie + " of 'vertex'"});
    std::string binary = test::plyBinary();
    binary.replace(binary.find("vertex 5"), 8, std::string("vertex ") + lie);
    EXPECT_FALSE(read(binary)) << lie;
  }
  expectError("ply\nformat ascii 1.0\nelement vertex 1000000000000\nend_header\n", {"the file ends"});
  expectError(
      "ply\nformat binary_little_endian 1.0\nelement a 1\nproperty list uint double "
      "b\nend_header\n\xff\xff\xff\xff",
      {"the file ends here"});
}

TEST(PlyFile, IsChosenByExtension) {
  const auto folder = test::scratchFolder("ply_file");
  test::writeText(folder / "a.PLY", test::plyBinary());
  EXPECT_TRUE(readGroom(folder / "a.PLY"));
  EXPECT_TRUE(writeGroom(folder / "b.Ply", test::awkwardGroom()));
}

// What we write reads back the same bits, also of strands of more edges than 16 bits count.
TEST(PlyFile, WhatIsWrittenIsReadBack) {
  const auto path = test::scratchFolder("ply_written") / "groom.ply";
  for (const std::uint32_t longest : {2u, 65'536u, 65'537u}) {
    Groom groom;
    groom.addStrand(std::vector<Vec3f>{{0.1f, -2e-20f, 3e10f}, {0, -1, 0.3f}, {1.0f / 3, -2, 0}});
    std::vector<Vec3f> strand(longest);
    for (std::size_t i = 0; i < strand.size(); ++i) strand[i] = {1, -0.001f * static_cast<float>(i), 0};
    groom.addStrand(strand);
    ASSERT_TRUE(writeGroom(path, groom));
    const auto read = readGroom(path);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->groom.points, groom.points);
    EXPECT_EQ(read->groom.firstPoint, groom.firstPoint);
    EXPECT_TRUE(read->warnings.empty());
  }
}

}  // namespace
}  // namespace ringlet::ply_file_test
