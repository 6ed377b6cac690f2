// groom/strands_of_points.h: files of points alone become strands of as many points, in every format that can
// be such a file; a number that does not divide them is refused with both numbers.
#include "ringlet/groom/strands_of_points.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ringlet/groom/groom_file.h"
#include "tests/groom/groom_samples.h"
#include "tests/groom/strand_list_bytes.h"
#include "tests/support/test_support.h"

namespace ringlet::strands_of_points_test {
namespace {

using test::contains;

std::vector<Vec3f> twelvePoints() {
  std::vector<Vec3f> points;
  for (int i = 0; i < 12; ++i) points.push_back({0.5f * static_cast<float>(i), 1, -2});
  return points;
}

std::string plyOf(bool isText, const std::string& more = "") {
  std::string bytes = std::string("ply\nformat ") + (isText ? "ascii" : "binary_little_endian") +
                      " 1.0\nelement vertex 12\nproperty float x\nproperty float y\nproperty float z\n" +
                      more + "end_header\n";
  for (const Vec3f p : twelvePoints()) {
    if (isText) bytes += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
    for (const float number : {p.x, p.y, p.z})
      if (!isText) test::appendBytes(bytes, number);
  }
  return bytes;
}

std::string objOf() {
  std::string text;
  for (const Vec3f p : twelvePoints())
    text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  return text;
}

std::string usdOf() {
  std::string points;
  for (const Vec3f p : twelvePoints())
    points += (points.empty() ? "(" : ", (") + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " +
              std::to_string(p.z) + ")";
  return "#usda 1.0\ndef BasisCurves \"Hair\" { uniform token type = \"linear\" point3f[] points = [" +
         points + "] }\n";
}

struct Sample {
  const char *name, *what;
  std::string bytes;
};

std::vector<Sample> samples() {
  return {{"a.obj", "obj", objOf()},
          {"text.ply", "ply text", plyOf(true)},
          {"a.ply", "ply binary", plyOf(false)},
          {"empty.ply", "ply with elements of nothing",
           plyOf(true, "element face 0\nproperty list uchar int i\n")},
          {"a.usda", "usd", usdOf()}};
}

TEST(StrandsOfPoints, AreCutWhereTheNumberIsSaidAndTheRefusalNamesTheOption) {
  const auto folder = test::scratchFolder("strands_of_points");
  for (const Sample& sample : samples()) {
    test::writeText(folder / sample.name, sample.bytes);
    const auto refused = readGroom(folder / sample.name);
    ASSERT_FALSE(refused) << sample.what;
    for (const char* part : {"12 points", "--points-per-strand N", "points_per_strand of [groom]"})
      EXPECT_TRUE(contains(refused.error().message, part)) << sample.what << ": " << refused.error().message;
    for (const std::uint32_t each : {2u, 3u, 4u, 6u, 12u}) {
      const auto loaded = readGroom(folder / sample.name, {.pointsPerStrand = each});
      ASSERT_TRUE(loaded) << sample.what << ": " << loaded.error().message;
      ASSERT_EQ(loaded->groom.strandCount(), 12 / each);
      EXPECT_EQ(loaded->groom.points, twelvePoints()) << sample.what;
      for (std::size_t s = 0; s < 12 / each; ++s) EXPECT_EQ(loaded->groom.strand(s).size(), each);
    }
    for (const std::uint32_t each : {5u, 7u, 13u, 1u}) {
      const auto wrong = readGroom(folder / sample.name, {.pointsPerStrand = each});
      ASSERT_FALSE(wrong) << sample.what;
      EXPECT_TRUE(contains(wrong.error().message, std::to_string(each) + " points")) << wrong.error().message;
      if (each > 1) {
        EXPECT_TRUE(contains(wrong.error().message, "has 12 points")) << wrong.error().message;
      }
    }
  }
}

TEST(StrandsOfPoints, AMeshIsNoHairAndStrandsThatAreStatedCount) {
  const auto folder = test::scratchFolder("strands_of_points");
  test::writeText(folder / "mesh.obj", objOf() + "f 1 2 3\n");
  EXPECT_FALSE(readGroom(folder / "mesh.obj", {.pointsPerStrand = 4}));
  std::string mesh = plyOf(true, "element face 1\nproperty list uchar int vertex_indices\n") + "3 0 1 2\n";
  test::writeText(folder / "mesh.ply", mesh);
  const auto refused = readGroom(folder / "mesh.ply", {.pointsPerStrand = 4});
  ASSERT_FALSE(refused);
  EXPECT_TRUE(contains(refused.error().message, "mesh")) << refused.error().message;
  // A file that says where strands end is not cut otherwise.
  test::writeText(folder / "stated.obj", objOf() + "l 1 2 3\nl 4 5\n");
  const auto stated = readGroom(folder / "stated.obj", {.pointsPerStrand = 4});
  ASSERT_TRUE(stated);
  EXPECT_EQ(stated->groom.firstPoint, (std::vector<std::uint32_t>{0, 3, 5}));
  // Nothing is no strands.
  test::writeText(folder / "none.obj", "# nothing\n");
  EXPECT_FALSE(readGroom(folder / "none.obj", {.pointsPerStrand = 4}));
}

TEST(StrandsOfPoints, PointsThatAreNotFiniteAreRefused) {
  const auto folder = test::scratchFolder("strands_of_points");
  test::writeText(folder / "bad.obj", objOf() + "v nan 0 0\n");
  const auto bad = readGroom(folder / "bad.obj", {.pointsPerStrand = 13});
  ASSERT_FALSE(bad);
  EXPECT_TRUE(contains(bad.error().message, "line 13: found 'nan'")) << bad.error().message;
}

}  // namespace
}  // namespace ringlet::strands_of_points_test
