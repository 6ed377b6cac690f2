// groom/obj_file.h: the dialects of OBJ polylines, bits that come back, and errors that name their line.
#include "ringlet/groom/obj_file.h"

#include <gtest/gtest.h>

#include <clocale>
#include <locale>
#include <string>
#include <vector>

#include "ringlet/groom/generate.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/output/groom_writer.h"
#include "tests/groom/groom_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::obj_file_test {
namespace {

using test::contains;

// Points (1, 0, 0) to (6, 0, 0), so that a particle's x is its index in the file.
const std::string kSixPoints = "v 1 0 0\nv 2 0 0\nv 3 0 0\nv 4 0 0\nv 5 0 0\nv 6 0 0\n";

Result<LoadedGroom> read(const std::string& text) { return readObj(test::bytesOf(text), "test.obj"); }

// The strands as lists of x.
std::vector<std::vector<int>> strandsOf(const std::string& text) {
  const Result<LoadedGroom> loaded = read(text);
  if (!loaded) {
    ADD_FAILURE() << loaded.error().message;
    return {};
  }
  std::vector<std::vector<int>> strands;
  for (std::size_t s = 0; s < loaded->groom.strandCount(); ++s) {
    strands.emplace_back();
    for (Vec3f p : loaded->groom.strand(s)) strands.back().push_back(static_cast<int>(p.x));
  }
  return strands;
}
using Strands = std::vector<std::vector<int>>;

void expectError(const std::string& text, const std::vector<std::string>& parts) {
  const Result<LoadedGroom> loaded = read(text);
  ASSERT_FALSE(loaded) << "expected an error with '" << parts.front() << "' for:\n" << text;
  EXPECT_TRUE(contains(loaded.error().message, "test.obj")) << loaded.error().message;
  for (const std::string& part : parts)
    EXPECT_TRUE(contains(loaded.error().message, part)) << loaded.error().message;
}

TEST(ObjFile, OneLineIsAStrandRootFirst) {
  EXPECT_EQ(strandsOf(kSixPoints + "l 3 2 1\nl 4 5 6\n"), (Strands{{3, 2, 1}, {4, 5, 6}}));
  EXPECT_EQ(strandsOf(kSixPoints + "l 3 2 1\nl 4 5 6"), (Strands{{3, 2, 1}, {4, 5, 6}}));  // no end of line
}

TEST(ObjFile, ReadsTheDialects) {
  EXPECT_EQ(strandsOf(kSixPoints + "l -6 -5 -4\nv 7 0 0\nl -1 -2 -3\n"), (Strands{{1, 2, 3}, {7, 6, 5}}));
  EXPECT_EQ(strandsOf(kSixPoints + "vt 0 1\nl 1/1 2/1 3/1\n"), (Strands{{1, 2, 3}}));
  EXPECT_EQ(strandsOf(kSixPoints + "l 1 \\\n 2 \\\r\n 3\\\n 4\nl 5 6\n"), (Strands{{1, 2, 3, 4}, {5, 6}}));
  EXPECT_EQ(strandsOf("l 1 2 3\n" + kSixPoints), (Strands{{1, 2, 3}}));  // lines before their points
  EXPECT_EQ(strandsOf("\xef\xbb\xbf" + kSixPoints + "l 1 2 3\n"), (Strands{{1, 2, 3}}));
  EXPECT_EQ(strandsOf("v\t1 0\t0 1.0 0.5 0.5 0.5 \n v 2 0 0\nv 3 0 0 # comment \\\nl 1 2 3 # 4\n"),
            (Strands{{1, 2, 3}}));
  EXPECT_EQ(strandsOf("v 1 \\\n 0 \\\n 0\nv 2 0 0\nv 3 0 0\nl +1 +2 +3\n"), (Strands{{1, 2, 3}}));

  std::string carriage = kSixPoints + "l 1 2 3\nl 4 5 6\n", old = carriage;
  for (std::size_t at = 0; (at = carriage.find('\n', at)) != std::string::npos; at += 2)
    carriage.insert(at, 1, '\r');
  for (char& c : old) c = c == '\n' ? '\r' : c;
  EXPECT_EQ(strandsOf(carriage), (Strands{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(strandsOf(old), (Strands{{1, 2, 3}, {4, 5, 6}}));
}

TEST(ObjFile, IgnoresWhatIsNoHair) {
  const Result<LoadedGroom> loaded =
      read("# a file\nmtllib a.mtl\no hair\ng one\ns off\nusemtl brown\n" + kSixPoints +
           "vn 0 0 nonsense\nvt 0\nf 1 2 3\nf 1//1 2//2 \\\n3//3\n\n   \nl 1 2 3\n");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(loaded->warnings.empty());
  EXPECT_EQ(loaded->groom.points.size(), 3u);

  const Result<LoadedGroom> unknown = read(kSixPoints + "\nhello world\nV 1 2 3\nl 1 2 3\n");
  ASSERT_TRUE(unknown) << unknown.error().message;
  ASSERT_EQ(unknown->warnings.size(), 1u);
  EXPECT_TRUE(contains(unknown->warnings[0], "line 8: 'hello' is no OBJ keyword; ignored, as 2 such lines"))
      << unknown->warnings[0];
}

TEST(ObjFile, JoinsEdges) {
  EXPECT_EQ(strandsOf(kSixPoints + "l 1 2\nl 2 3\nl 4 5\nl 5 6\n"), (Strands{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(strandsOf(kSixPoints + "l 5 6\nl 1 2\nl 3 4\nl 2 3\n"), (Strands{{5, 6}, {1, 2, 3, 4}}));
  EXPECT_EQ(strandsOf(kSixPoints + "l 2 1\nl 3 2\n"), (Strands{{3, 2, 1}}));
  // Longer lines are strands by themselves, in the order of the file; they may share points.
  EXPECT_EQ(strandsOf(kSixPoints + "l 4 5\nl 1 2 3\nl 3 2 6\nl 5 6\n"),
            (Strands{{4, 5, 6}, {1, 2, 3}, {3, 2, 6}}));

  const Result<LoadedGroom> mixed = read(kSixPoints + "l 1 2\nl 3 2\nl 3 4\n");
  ASSERT_TRUE(mixed) << mixed.error().message;
  ASSERT_EQ(mixed->warnings.size(), 1u);
  EXPECT_TRUE(contains(mixed->warnings[0], "1 strands are joined from edges of both directions"))
      << mixed->warnings[0];
}

TEST(ObjFile, LeavesOutLinesOfOnePoint) {
  const Result<LoadedGroom> loaded = read(kSixPoints + "l 1\nl 1 2 3\nl 4\n");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->groom.strandCount(), 1u);
  ASSERT_EQ(loaded->warnings.size(), 1u);
  EXPECT_TRUE(contains(loaded->warnings[0], "left out 2 'l' lines of one point")) << loaded->warnings[0];
  expectError(kSixPoints + "l 1\nl 4\n", {"6 points", "2 lines ('l') of one point each"});
}

TEST(ObjFile, NumbersInAllForms) {
  const Result<LoadedGroom> loaded =
      read("v +1.5 -.5 1.\nv 1e2 -2.5E-1 1e+1\nv 1e-60 -1e-400 3e-45\nl 1 2 3\n");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->groom.points[0], (Vec3f{1.5f, -0.5f, 1}));
  EXPECT_EQ(loaded->groom.points[1], (Vec3f{100, -0.25f, 10}));
  EXPECT_EQ(loaded->groom.points[2], (Vec3f{0, 0, 3e-45f}));  // nearer to 0 than any float is 0
}

TEST(ObjFile, RefusesBadNumbers) {
  for (const char* word : {"x", "1,5", "1.5f", "0x10", "nan", "inf", "-infinity", "1e39", "1e999", "-1e400",
                           "--1", "+-1", "1..2", "1e", "."}) {
    expectError("v 0 0 0\nv 0 " + std::string(word) + " 0\nl 1 2\n",
                {"line 2", "found '" + std::string(word) + "'", "finite numbers"});
  }
  expectError("v 0 0\nv 0 0 0\nl 1 2\n", {"line 1", "found the end of the line", "three"});
  expectError("v\n", {"line 1", "found the end of the line"});
  expectError("v 1 2 # 3\n", {"line 1", "found the end of the line"});
}

TEST(ObjFile, RefusesBadIndices) {
  expectError(kSixPoints + "l 1 0 2\n", {"line 7", "found '0'", "counted from 1"});
  expectError(kSixPoints + "l 1 2 7\n", {"line 7", "index 7", "at most 6"});
  expectError(kSixPoints + "\n\nl 1 2\nl 7 3\n", {"line 10", "index 7"});
  expectError(kSixPoints + "l 1 -7 2\n", {"line 7", "found '-7'", "6 points above"});
  expectError("l -1 -2\n" + kSixPoints, {"line 1", "0 points above"});
  for (const char* word : {"x", "1.5", "1/x", "/1", "1e3", "99999999999999999999", "-99999999999999999999",
                           "4294967297", "nan", "--1", "+-1", "-+1", "++1", "+", "-"}) {
    expectError(kSixPoints + "l 1 " + word + " 2\n", {"line 7", "found '" + std::string(word)});
  }
  expectError(kSixPoints + "# \\\nl 1 \\\r\n2 3\r\nl 1 0 2\n", {"line 10", "found '0'"});
  expectError(kSixPoints + "l\n", {"line 7", "'l' without indices"});
}

TEST(ObjFile, RefusesLoopsAndBranches) {
  expectError(kSixPoints + "l 1 2 3 1\n", {"line 7", "a closed loop", "root and a tip"});
  expectError(kSixPoints + "l 1 2\nl 2 3\nl 3 1\n", {"line 7", "a closed loop"});
  expectError(kSixPoints + "l 1 2\nl 2 3\nl 2 4\n", {"line 9", "third edge at point 2"});
  expectError(kSixPoints + "l 2 2\n", {"line 7", "to itself"});
}

TEST(ObjFile, RefusesFilesWithoutStrands) {
  expectError("", {"0 points", "no polylines"});
  expectError("\n\n# nothing\n", {"no polylines"});
  expectError(kSixPoints, {"6 points", "no polylines", "l 1 2 3"});
  expectError(kSixPoints, {"--points-per-strand N"});
  expectError(kSixPoints + "f 1 2 3\n", {"1 faces", "no polylines"});
  expectError(std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16) + "\xff\xfe", {"no polylines"});
  expectError("HAIR" + std::string(200, '\0'), {"no polylines"});
}

TEST(ObjFile, ShowsGarbageAsPrintableText) {
  const Result<LoadedGroom> loaded = read("v 0 \x1b[31m\xff 0\n");
  ASSERT_FALSE(loaded);
  EXPECT_TRUE(contains(loaded.error().message, "'\\x1b[31m\\xff'")) << loaded.error().message;
  const Result<LoadedGroom> longWord = read("v 0 " + std::string(100000, 'x') + " 0\n");
  ASSERT_FALSE(longWord);
  EXPECT_LT(longWord.error().message.size(), 200u);
}

TEST(ObjFile, WritesWhatItReads) {
  const auto folder = test::scratchFolder("obj_file");
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const Groom groom = seed == 0 ? test::awkwardGroom() : test::randomGroom(seed, 1 + 7 * int(seed));
    ASSERT_TRUE(writeGroom(folder / "a.obj", groom));
    const Result<LoadedGroom> loaded = readGroom(folder / "a.obj");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(loaded->warnings.empty());
    EXPECT_TRUE(test::hasSameBits(loaded->groom, groom)) << "seed " << seed;
  }
  EXPECT_EQ(test::fileCount(folder), 1);
}

TEST(ObjFile, WritesOtherPositions) {
  const auto folder = test::scratchFolder("obj_frame");
  Groom groom = test::awkwardGroom();
  std::vector<Vec3f> moved(groom.points.size());
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = {float(i), 0.1f, -float(i)};
  ASSERT_TRUE(writeObj(folder / "frame.obj", groom, moved));
  const Result<LoadedGroom> loaded = readGroom(folder / "frame.obj");
  ASSERT_TRUE(loaded) << loaded.error().message;
  groom.points = moved;
  EXPECT_TRUE(test::hasSameBits(loaded->groom, groom));
  EXPECT_TRUE(contains(test::readText(folder / "frame.obj"), "\nl 1 2\nl 3 4 5\nl 6 7 8 9\n"));

  moved[3].y = std::numeric_limits<float>::quiet_NaN();
  const Status status = writeObj(folder / "frame.obj", groom, moved);
  ASSERT_FALSE(status);
  EXPECT_TRUE(contains(status.error().message, "strand 1, particle 1 is (3, nan, -3)"))
      << status.error().message;
}

// A locale that writes one thousand and a half as 1.000,5.
struct Comma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(ObjFile, DoesNotCareAboutTheLocale) {
  // The locale of C++, and that of C where one with a comma is installed.
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  if (!std::setlocale(LC_NUMERIC, "de_DE.UTF-8")) std::setlocale(LC_NUMERIC, "fr_FR.UTF-8");
  const auto folder = test::scratchFolder("obj_locale");
  const bool isWritten = bool(writeGroom(folder / "a.obj", test::awkwardGroom()));
  const Result<LoadedGroom> loaded = readGroom(folder / "a.obj");
  std::locale::global(before);
  std::setlocale(LC_NUMERIC, "C");
  ASSERT_TRUE(isWritten);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(test::hasSameBits(loaded->groom, test::awkwardGroom()));
}

TEST(ObjFile, ReadsTenThousandStrandsBitForBit) {
  const auto folder = test::scratchFolder("obj_large");
  SwatchParameters parameters{.columnCount = 100, .rowCount = 100};
  parameters.curl.particleCount = 16;
  const Result<Groom> groom = makeSwatch(parameters);
  ASSERT_TRUE(groom);
  ASSERT_TRUE(writeGroom(folder / "a.obj", *groom));
  const Result<LoadedGroom> loaded = readGroom(folder / "a.obj");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->groom.points.size(), 160000u);
  EXPECT_TRUE(test::hasSameBits(loaded->groom, *groom));
}

TEST(ObjFile, ReadsRealHair) {
  RINGLET_NEEDS_DATA(path, "curlycue/frame_000.obj");
  const Result<LoadedGroom> loaded = readGroom(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(loaded->warnings.empty());
  EXPECT_EQ(loaded->groom.strandCount(), 98u);
  EXPECT_EQ(loaded->groom.points.front(), (Vec3f{-12.2615f, 8.72861f, -6.15285f}));
  for (std::size_t s = 0; s < 98; ++s) {
    EXPECT_GE(loaded->groom.strand(s).size(), 93u);
    EXPECT_LE(loaded->groom.strand(s).size(), 123u);
  }
}

TEST(ObjFile, SaysWhatAMeshOrAPointCloudLacks) {
  RINGLET_NEEDS_DATA(cloud, "curlycue/sideSwatchGuides.obj");
  RINGLET_NEEDS_DATA(mesh, "sintel/sintel.obj");
  for (const auto& path : {cloud, mesh}) {
    const Result<LoadedGroom> loaded = readGroom(path);
    ASSERT_FALSE(loaded);
    EXPECT_TRUE(contains(loaded.error().message, "no polylines")) << loaded.error().message;
  }
}

}  // namespace
}  // namespace ringlet::obj_file_test
