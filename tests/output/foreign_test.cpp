// Animations of other programs: curves that move in USD and Alembic, a file a frame, point caches.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "ringlet/output/animation_reader.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/groom_writer.h"
#include "tests/support/test_support.h"

namespace ringlet::foreign_test {
namespace {

namespace fs = std::filesystem;
using test::scratchFolder;

void put(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

std::string metadata(const std::string& more) {
  return "#usda 1.0\n(\n metersPerUnit = 0.1\n" + more + ")\n";
}

// One curve of three points whose x is given at some times.
std::string movingCurve(const std::vector<std::pair<double, double>>& xOfTime, const std::string& more = "") {
  std::string text = metadata(more) +
                     "def Xform \"Head\" {\n def BasisCurves \"Hair\" {\n  uniform token type = \"linear\"\n"
                     "  int[] curveVertexCounts = [3]\n  float[] widths = [0.2, 0.2, 0.1]\n"
                     "  point3f[] points.timeSamples = {\n";
  for (const auto& [time, x] : xOfTime)
    text += fmt::format("{}", time) + ": [(" + std::to_string(x) + ", 0, 1), (1, 0, 1), (2, 0, 1)],\n";
  return text + "  }\n }\n}\n";
}

std::vector<float> xOfFrames(AnimationReader& reader) {
  std::vector<float> all;
  for (int frame = 1; frame <= reader.frameCount(); ++frame) {
    const Status read = reader.readFrame(frame);
    EXPECT_TRUE(read) << read.error().message;
    all.push_back(read ? reader.groom().points[0].x : NAN);
  }
  return all;
}

// Times of samples and what becomes of them: frames at even steps that all samples are on, or as many as
// samples.
struct Timing {
  std::vector<std::pair<double, double>> samples;
  std::string metadata;
  double framesPerSecond;
  std::vector<float> x;
  bool isEven = true;
};

TEST(Foreign, FramesAreAtEvenSteps) {
  const fs::path path = scratchFolder("foreign") / "hair.usda";
  for (const Timing& timing : {
           Timing{{{1, 0}, {2, 1}, {3, 4}}, "", 24, {0, 1, 4}},
           Timing{{{3, 4}, {1, 0}, {2, 1}}, "", 24, {0, 1, 4}},
           Timing{{{101, 0}, {102, 1}, {104, 5}}, "timeCodesPerSecond = 30\n", 30, {0, 1, 3, 5}},
           Timing{{{0, 0}, {5, 1}}, "timeCodesPerSecond = 30\n", 6, {0, 1}},
           Timing{{{0.75, 0}, {1, 1}, {1.25, 2}, {1.75, 4}}, "", 96, {0, 1, 2, 3, 4}},
           Timing{{{0, 0}, {1, 1}, {2.31, 2.31}, {4, 4}}, "", 18, {0, 4 / 3.f, 8 / 3.f, 4}, false},
       }) {
    put(path, movingCurve(timing.samples, timing.metadata));
    EXPECT_TRUE(holdsAnimation(path));
    auto reader = AnimationReader::open(path);
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_DOUBLE_EQ(reader->header().framesPerSecond, timing.framesPerSecond);
    const std::vector<float> x = xOfFrames(*reader);
    ASSERT_EQ(x.size(), timing.x.size());
    for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(x[k], timing.x[k], 1e-6) << k;
    EXPECT_EQ(reader->warnings().size(), timing.isEven ? 0U : 1U);
    if (!timing.isEven) {
      EXPECT_NE(reader->warnings()[0].find("not at even times"), std::string::npos) << reader->warnings()[0];
    }
  }
}

TEST(Foreign, UnitAxisWidthAndTransformsAreTheFiles) {
  const fs::path path = scratchFolder("foreign") / "hair.usda";
  std::string text = movingCurve({{1, 0}, {2, 1}}, " upAxis = \"Z\"\n");
  const std::string prim = "def Xform \"Head\" {\n";
  text.insert(text.find(prim) + prim.size(),
              " double3 xformOp:translate.timeSamples = {1: (0, 0, 0), 2: (0, 10, 0)}\n"
              " uniform token[] xformOpOrder = [\"xformOp:translate\"]\n");
  put(path, text);
  auto reader = AnimationReader::open(path);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ(reader->header().metresPerUnit, 0.1);
  EXPECT_TRUE(reader->statesUnit());
  EXPECT_EQ(reader->header().up, UpAxis::z);
  EXPECT_EQ(reader->header().diameter, 0.2f);
  EXPECT_STREQ(reader->formatKey(), "usda");
  ASSERT_TRUE(reader->readFrame(2));
  EXPECT_EQ(reader->groom().points[0], (Vec3f{1, 10, 1}));

  // Another axis and unit; roots at the last points.
  auto turned = AnimationReader::open(path, {.metresPerUnit = 1, .upIsZ = false, .rootEnd = RootEnd::last});
  ASSERT_TRUE(turned) << turned.error().message;
  EXPECT_EQ(turned->header().metresPerUnit, 1);
  EXPECT_EQ(turned->header().up, UpAxis::y);
  ASSERT_TRUE(turned->readFrame(2));
  EXPECT_EQ(turned->groom().points[0], (Vec3f{2, 1, -10}));
  EXPECT_EQ(turned->groom().points[2], (Vec3f{1, 1, -10}));
}

// What a camera or an invisible prim beside the curves does is none of their frames.
TEST(Foreign, OnlyWhatMovesTheCurvesHasTimes) {
  const fs::path path = scratchFolder("foreign") / "hair.usda";
  put(path,
      movingCurve({{1, 0}, {2, 1}}) +
          "def Camera \"Camera\" {\n double3 xformOp:translate.timeSamples = {1.3: (0, 0, 0), 9: (0, 1, 0)}\n"
          " uniform token[] xformOpOrder = [\"xformOp:translate\"]\n}\n");
  auto reader = AnimationReader::open(path);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ(reader->frameCount(), 2);
}

TEST(Foreign, HairThatIsNotDrawnMovesNothing) {
  const fs::path path = scratchFolder("foreign") / "hair.usda";
  std::string hidden = movingCurve({{1, 0}, {2, 1}}).substr(metadata("").size());
  const std::string prim = "def BasisCurves \"Hair\" {\n";
  hidden.insert(hidden.find(prim) + prim.size(), "  token visibility = \"invisible\"\n");
  std::string shown = movingCurve({{1, 0}});
  shown.replace(shown.find("\"Head\""), 6, "\"Other\"");
  put(path, shown + hidden);
  EXPECT_FALSE(holdsAnimation(path));
}

// As at its first sample.
TEST(Foreign, HairThatIsHiddenLaterStays) {
  const fs::path path = scratchFolder("foreign") / "hair.usda";
  std::string text = movingCurve({{1, 0}, {2, 1}});
  const std::string prim = "def BasisCurves \"Hair\" {\n";
  text.insert(text.find(prim) + prim.size(),
              "  token visibility.timeSamples = {1: \"inherited\", 2: \"invisible\"}\n");
  put(path, text);
  auto reader = AnimationReader::open(path);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ(xOfFrames(*reader), (std::vector<float>{0, 1}));
}

TEST(Foreign, HairThatIsNotThereAtFirstBeginsWhereItIs) {
  const fs::path path = scratchFolder("foreign") / "hair.usda";
  put(path, metadata("") +
                "def BasisCurves \"Hair\" {\n uniform token type = \"linear\"\n"
                " int[] curveVertexCounts.timeSamples = {1: [], 2: [], 3: [2], 4: [2], 5: [2]}\n"
                " point3f[] points.timeSamples = {1: [], 2: [], 3: [(3, 0, 0), (1, 0, 0)],\n"
                "  4: [(4, 0, 0), (1, 0, 0)], 5: [(5, 0, 0), (1, 0, 0)]}\n}\n");
  auto reader = AnimationReader::open(path);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ(reader->header().framesPerSecond, 24);
  EXPECT_EQ(xOfFrames(*reader), (std::vector<float>{3, 4, 5}));
  ASSERT_EQ(reader->warnings().size(), 1U);
  EXPECT_NE(reader->warnings()[0].find("no hair before 0.125 s"), std::string::npos) << reader->warnings()[0];
}

TEST(Foreign, AGroomThatDoesNotMoveIsNone) {
  const fs::path path = scratchFolder("foreign") / "hair.usda";
  put(path, movingCurve({{1, 0}}));
  EXPECT_FALSE(holdsAnimation(path));
  const auto reader = AnimationReader::open(path);
  ASSERT_FALSE(reader);
  EXPECT_NE(reader.error().message.find("none of its curves move"), std::string::npos)
      << reader.error().message;
}

TEST(Foreign, TimesOfNoAnimationAreRefused) {
  const fs::path path = scratchFolder("foreign") / "hair.usda";
  for (const auto& [first, last] : {std::pair(-1e308, 1e308), std::pair(0.0, 1e9), std::pair(0.0, 1e-6)}) {
    put(path, movingCurve({{first, 0}, {last, 1}}));
    const auto reader = AnimationReader::open(path);
    ASSERT_FALSE(reader) << last;
    EXPECT_NE(reader.error().message.find("frames a second"), std::string::npos) << reader.error().message;
  }
}

TEST(Foreign, AFrameOfOtherStrandsIsRefused) {
  const fs::path path = scratchFolder("foreign") / "hair.usda";
  put(path, metadata("") +
                "def BasisCurves \"Hair\" {\n uniform token type = \"linear\"\n"
                " int[] curveVertexCounts.timeSamples = {1: [3], 2: [4]}\n"
                " point3f[] points.timeSamples = {1: [(0, 0, 0), (1, 0, 0), (2, 0, 0)],\n"
                "  2: [(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)]}\n}\n");
  auto reader = AnimationReader::open(path);
  ASSERT_TRUE(reader) << reader.error().message;
  ASSERT_TRUE(reader->readFrame(1));
  const Status read = reader->readFrame(2);
  ASSERT_FALSE(read);
  for (const char* part : {"frame 2 has 1 strands of 4 points", "frame 1 1 of 3"})
    EXPECT_NE(read.error().message.find(part), std::string::npos) << read.error().message;
}

// --- A file a frame.

Groom threeStrands(float x) {
  Groom groom;
  for (const float z : {0.f, 1.f, 2.f}) groom.addStrand(std::vector<Vec3f>{{x, 0, z}, {x, 1, z}, {x, 2, z}});
  return groom;
}

TEST(Foreign, ASequenceHasAFileAFrame) {
  for (const char* ending : {".obj", ".ply", ".hair", ".abc"}) {
    const fs::path folder = scratchFolder("foreign_sequence");
    for (const int number : {9, 10, 11})
      ASSERT_TRUE(
          writeGroom(folder / ("a." + std::string(number < 10 ? "0" : "") + std::to_string(number) + ending),
                     threeStrands(static_cast<float>(number))));
    put(folder / (std::string("a.x") + ending), "none of them");
    put(folder / (std::string("a.1") + ending), "too few digits");
    const fs::path path = folder / (std::string("a.##") + ending);
    EXPECT_TRUE(holdsAnimation(path));
    auto reader = AnimationReader::open(path, {.framesPerSecond = 30});
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_EQ(reader->header().framesPerSecond, 30);
    EXPECT_STREQ(reader->formatKey(), "sequence");
    EXPECT_EQ(reader->byteCount(), 0U);
    EXPECT_EQ(xOfFrames(*reader), (std::vector<float>{9, 10, 11})) << ending;
    // A gap is named, and so is a name without a file.
    fs::remove(folder / (std::string("a.10") + ending));
    const auto gap = AnimationReader::open(path);
    ASSERT_FALSE(gap);
    EXPECT_NE(gap.error().message.find("number 10 is missing between 9 and 11"), std::string::npos)
        << gap.error().message;
    const auto none = AnimationReader::open(folder / (std::string("b.##") + ending));
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find("there is no such file"), std::string::npos) << none.error().message;
  }
}

// --- Point caches.

TEST(Foreign, APointCacheMovesTheGroomBesideIt) {
  const fs::path folder = scratchFolder("foreign_cache"), path = folder / "hair.pc2";
  const Groom rest = threeStrands(0);
  {
    auto writer =
        createAnimation(path, rest, {.framesPerSecond = 24, .metresPerUnit = 0.01, .frameCount = 2});
    ASSERT_TRUE(writer) << writer.error().message;
    for (const float x : {4.f, 5.f}) ASSERT_TRUE((*writer)->addFrame(threeStrands(x).points));
    ASSERT_TRUE((*writer)->finish());
  }
  ASSERT_TRUE(writeGroom(folder / "other.obj", rest));
  for (const fs::path& groom : {fs::path(), folder / "other.obj"}) {
    auto reader = AnimationReader::open(path, {.groom = groom});
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_EQ(reader->groom().firstPoint, rest.firstPoint);
    EXPECT_STREQ(reader->formatKey(), "pc2");
    const std::vector<float> x = xOfFrames(*reader);
    EXPECT_EQ(std::vector<float>(x.end() - 2, x.end()), (std::vector<float>{4, 5}));
  }
  Groom fewer = rest;
  fewer.points.pop_back();
  fewer.firstPoint.back() -= 1;
  ASSERT_TRUE(writeGroom(folder / "fewer.obj", fewer));
  const auto refused = AnimationReader::open(path, {.groom = folder / "fewer.obj"});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("has 9 points, and the groom"), std::string::npos)
      << refused.error().message;
  fs::remove(folder / "hair.obj");
  const auto alone = AnimationReader::open(path);
  ASSERT_FALSE(alone);
  EXPECT_NE(alone.error().message.find("holds points without strands"), std::string::npos)
      << alone.error().message;
}

// --- Files of the Alembic library.

TEST(Foreign, CurvesOfTheAlembicLibraryMove) {
  RINGLET_NEEDS_DATA(path, "abc/curves_linear_animated.abc");
  auto reader = AnimationReader::open(path);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ(reader->frameCount(), 12);
  EXPECT_EQ(reader->header().framesPerSecond, 24);
  EXPECT_FALSE(reader->statesUnit());
  EXPECT_EQ(reader->header().diameter, 0.01f);
  EXPECT_EQ(reader->groom().strandCount(), 8U);
  // In the object's space the first point is (0, 10, 0), the last x 6.60312 at first and 7.09357 at last; the
  // head moves by (0.5 f, 0, 0) and turns 5 f degrees, below (0, 150, 0).
  for (int frame = 1; frame <= 12; ++frame) {
    ASSERT_TRUE(reader->readFrame(frame));
    const double f = frame - 1;
    EXPECT_NEAR(length(Vec3d(reader->groom().points[0]) - Vec3d{0.5 * f, 160, 0}), 0, 1e-4) << frame;
    if (frame != 1 && frame != 12) continue;
    const double turn = 5 * f * M_PI / 180, x = frame == 1 ? 6.60312 : 7.09357, z = 2.52559;
    const Vec3d last{0.5 * f + x * std::cos(turn) + z * std::sin(turn), 152,
                     z * std::cos(turn) - x * std::sin(turn)};
    EXPECT_NEAR(length(Vec3d(reader->groom().points[263]) - last), 0, 1e-3) << frame;
  }
}

TEST(Foreign, CurvesOfTheAlembicLibraryThatChangeAreRefused) {
  RINGLET_NEEDS_DATA(path, "abc/curves_topology_changes.abc");
  auto reader = AnimationReader::open(path);
  ASSERT_TRUE(reader) << reader.error().message;
  ASSERT_TRUE(reader->readFrame(1));
  const Status read = reader->readFrame(2);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("frame 2 has 4 strands of 40 points"), std::string::npos)
      << read.error().message;
}

}  // namespace
}  // namespace ringlet::foreign_test
