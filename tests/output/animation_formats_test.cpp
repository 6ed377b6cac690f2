// Every format of animations, by the table: what is written is read back, every bit or within the bound that
// is stated; after every frame, of fewer frames than were announced, on a full disk.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "ringlet/output/animation_reader.h"
#include "ringlet/output/animation_writer.h"
#include "tests/support/test_support.h"

namespace ringlet::animation_formats_test {
namespace {

namespace fs = std::filesystem;
using test::readText;
using test::scratchFolder;

constexpr int kFrames = 7;

// Strands of 2, 3, 31 and 2 particles at seeded places, from tenths of a micrometre to a kilometre.
Groom mixedGroom() {
  Groom groom;
  groom.metresPerUnit = 0.00254;
  std::mt19937 random(5);
  std::uniform_real_distribution<float> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-20, 10);
  for (const int count : {2, 3, 31, 2}) {
    std::vector<Vec3f> strand(static_cast<std::size_t>(count));
    for (Vec3f& p : strand) {
      p = {std::ldexp(mantissa(random), exponent(random)), mantissa(random),
           std::ldexp(mantissa(random), exponent(random))};
    }
    groom.addStrand(strand);
  }
  return groom;
}

void putText(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

// Of a frame, and where the head is: it turns and moves.
std::vector<Vec3f> pointsAt(const Groom& groom, int frame) {
  auto points = groom.points;
  for (Vec3f& p : points) p.y += static_cast<float>(frame) / 3;
  return points;
}
UsdTransform headAt(int frame) {
  const double angle = 0.3 * frame;
  return {{Vec3d{std::cos(angle), std::sin(angle), 0}, Vec3d{-std::sin(angle), std::cos(angle), 0},
           Vec3d{0, 0, 1}},
          {0.1 * frame, -2, 3}};
}

// A format with what may be asked of it.
struct Case {
  std::string name;
  const AnimationFormat* format;
  AnimationOptions options;
  double rounding = 0;  // of points, beside the bound that the file states [share of the largest coordinate]
};

std::vector<Case> cases() {
  std::vector<Case> all;
  const AnimationOptions plain{.framesPerSecond = 30,
                               .metresPerUnit = 0.00254,
                               .up = UpAxis::z,
                               .diameter = 0.25f,
                               .frameCount = kFrames};
  for (const AnimationFormat& format : animationFormats()) {
    if (!format.isRead) continue;  // pc2_writer_test.cpp
    const std::string name = format.extension;
    all.push_back({name, &format, plain});
    if (format.hasPrecisions) {
      all.push_back({name + " of 16 bits", &format, plain});
      all.back().options.precision = CachePrecision::bits16;
      continue;
    }
    all.push_back({name + " with all values", &format, plain});
    all.back().options.usd = {.tipDiameter = 0.05f, .ids = true, .rest = true, .velocities = true};
    // Brought to the head's frame and back, each with one rounding to float32 of coordinates, which may be
    // larger by what the head moves.
    all.push_back({name + " seen from the head", &format, plain, 4 * 0x1p-24});
    all.back().options.usd = {.ids = true, .velocities = true, .head = UsdHead::transform};
  }
  return all;
}

class Formats : public testing::TestWithParam<Case> {
 protected:
  Result<std::unique_ptr<AnimationWriter>> begin() const {
    return GetParam().format->resume(path_, groom_, GetParam().options, 0);
  }
  void add(AnimationWriter& writer, int from, int to) const {
    for (int frame = from; frame <= to; ++frame) {
      const Status added = writer.addFrame(pointsAt(groom_, frame), headAt(frame));
      ASSERT_TRUE(added) << added.error().message;
    }
  }
  // Reads the file and holds every frame against what was written.
  void expectFrames(const fs::path& path, int frames) const {
    auto reader = AnimationReader::open(path);
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_EQ(reader->frameCount(), frames);
    EXPECT_EQ(reader->groom().firstPoint, groom_.firstPoint);
    EXPECT_EQ(reader->header().framesPerSecond, 30);
    EXPECT_EQ(reader->header().metresPerUnit, 0.00254);
    EXPECT_EQ(reader->header().up, UpAxis::z);
    EXPECT_EQ(reader->header().diameter, 0.25f);
    EXPECT_EQ(reader->isFinished(), path == path_);
    EXPECT_EQ(reader->byteCount(), fs::file_size(path));
    for (int frame = 1; frame <= frames; ++frame) {
      const Status read = reader->readFrame(frame);
      ASSERT_TRUE(read) << frame << ": " << read.error().message;
      expectPoints(reader->groom().points, pointsAt(groom_, frame), reader->errorBound(frame));
    }
  }
  void expectPoints(const std::vector<Vec3f>& found, const std::vector<Vec3f>& expected,
                    double boundMetres) const {
    const double bound = boundMetres / 0.00254;
    if (bound == 0 && GetParam().rounding == 0) {
      EXPECT_EQ(found, expected);
      return;
    }
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double size = length(Vec3d(expected[i])) + 5;  // the head moves by less than 5
      EXPECT_LE(length(Vec3d(found[i]) - Vec3d(expected[i])), bound + GetParam().rounding * size) << i;
    }
  }

  fs::path path_ = scratchFolder("formats") / (std::string("hair") + GetParam().format->extension);
  fs::path partial_ = path_.string() + ".partial";
  Groom groom_ = mixedGroom();
};

TEST_P(Formats, EveryFrameIsReadBack) {
  auto writer = begin();
  ASSERT_TRUE(writer) << writer.error().message;
  add(**writer, 1, kFrames);
  EXPECT_FALSE(fs::exists(path_)) << "the name is for finished files";
  const Status finished = (*writer)->finish();
  ASSERT_TRUE(finished) << finished.error().message;
  EXPECT_FALSE(fs::exists(partial_));
  expectFrames(path_, kFrames);
  EXPECT_TRUE(holdsAnimation(path_));
}

// As if another program had written it.
TEST_P(Formats, ItsCurvesMoveForWhoeverReadsThem) {
  if (path_.extension() == ".rgc") return;  // nobody else's
  auto writer = begin();
  ASSERT_TRUE(writer) << writer.error().message;
  add(**writer, 1, kFrames);
  ASSERT_TRUE((*writer)->finish());
  auto reader = ForeignReader::open(path_, {.metresPerUnit = 0.00254, .upIsZ = true});
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ(reader->frameCount(), kFrames);
  EXPECT_EQ(reader->firstPoint(), groom_.firstPoint);
  EXPECT_EQ(reader->framesPerSecond(), 30);
  EXPECT_EQ(reader->diameter(), 0.25f);
  EXPECT_TRUE(reader->warnings().empty()) << reader->warnings()[0];
  for (int frame = kFrames; frame > 0; --frame) {
    std::vector<Vec3f> points;
    const Status read = reader->readFrame(frame, points);
    ASSERT_TRUE(read) << frame << ": " << read.error().message;
    expectPoints(points, pointsAt(groom_, frame), 0);
  }
}

TEST_P(Formats, AfterEveryFrameTheFileHasItAndThoseBeforeIt) {
  {
    auto writer = begin();
    ASSERT_TRUE(writer);
    for (int frame = 1; frame < kFrames; ++frame) {
      add(**writer, frame, frame);
      expectFrames(partial_, frame);
    }
  }
  EXPECT_TRUE(fs::exists(partial_)) << "what there is stays";
  EXPECT_TRUE(holdsAnimation(partial_));
}

TEST_P(Formats, FewerFramesThanAnnouncedMakeAWholeFile) {
  for (const int frames : {1, 2, 3}) {
    auto writer = begin();
    ASSERT_TRUE(writer);
    add(**writer, 1, frames);
    ASSERT_TRUE((*writer)->finish());
    expectFrames(path_, frames);
  }
}

TEST_P(Formats, NothingIsLeftOfAFileWithoutFrames) {
  { ASSERT_TRUE(begin()); }
  EXPECT_FALSE(fs::exists(partial_));
  EXPECT_FALSE(fs::exists(path_));
}

TEST_P(Formats, AFullDiskKeepsTheFramesBefore) {
  std::uintmax_t three = 0;
  {
    auto writer = begin();
    ASSERT_TRUE(writer);
    add(**writer, 1, 3);
    three = fs::file_size(partial_);
  }
  auto writer = begin();
  ASSERT_TRUE(writer);
  add(**writer, 1, 3);
  std::signal(SIGXFSZ, SIG_IGN);
  struct rlimit before {};
  getrlimit(RLIMIT_FSIZE, &before);
  struct rlimit small = before;
  small.rlim_cur = three + 20;
  setrlimit(RLIMIT_FSIZE, &small);
  const Status added = (*writer)->addFrame(pointsAt(groom_, 4), headAt(4));
  setrlimit(RLIMIT_FSIZE, &before);
  ASSERT_FALSE(added);
  EXPECT_EQ(added.error().fault, Fault::diskFull);
  EXPECT_NE(added.error().message.find("the first 3 frames are kept in " + partial_.string()),
            std::string::npos)
      << added.error().message;
  writer = Error{"closed"};
  expectFrames(partial_, 3);
}

TEST_P(Formats, AMissingFolderIsNamed) {
  const fs::path path = path_.parent_path() / "no" / path_.filename();
  const auto writer = GetParam().format->resume(path, groom_, GetParam().options, 0);
  ASSERT_FALSE(writer);
  EXPECT_NE(writer.error().message.find(path.string()), std::string::npos) << writer.error().message;
  EXPECT_EQ(writer.error().fault, Fault::output);
}

// What has the name of the unfinished file, and is none: a link could lead to any file of the user's, and a
// pipe has no places.
TEST_P(Formats, WhatIsNoFileIsNotWrittenTo) {
  const auto expectRefused = [&](const std::string& why) {
    const auto writer = begin();
    ASSERT_FALSE(writer) << why;
    EXPECT_EQ(writer.error().message, "cannot write " + partial_.string() + ": it is " + why);
    EXPECT_EQ(writer.error().fault, Fault::output);
    fs::remove(partial_);
  };
  putText(path_.parent_path() / "precious", "text");
  fs::create_symlink("precious", partial_);
  expectRefused("a symbolic link; remove it");
  EXPECT_EQ(readText(path_.parent_path() / "precious"), "text");
  fs::create_symlink("/dev/full", partial_);
  expectRefused("a symbolic link; remove it");
  ASSERT_EQ(mkfifo(partial_.c_str(), 0600), 0);
  expectRefused("not a regular file");
}

// A byte of a finished file that is changed is never a crash, nor a frame that is not finite.
TEST_P(Formats, DamageIsRefusedOrHarmless) {
  auto writer = begin();
  ASSERT_TRUE(writer);
  add(**writer, 1, 3);
  ASSERT_TRUE((*writer)->finish());
  const std::string whole = readText(path_);
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    std::string damaged = whole;
    const std::size_t at =
        i < 200 ? random() % std::min<std::size_t>(whole.size(), 3000) : random() % whole.size();
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << random() % 8));
    putText(path_, i % 7 == 0 ? damaged.substr(0, at) : damaged);
    auto reader = AnimationReader::open(path_);
    for (int frame = 1; reader && frame <= reader->frameCount(); ++frame) {
      if (!reader->readFrame(frame)) continue;
      for (const Vec3f p : reader->groom().points)
        ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AnimationFormats, Formats, testing::ValuesIn(cases()), [](const auto& one) {
  std::string name;
  for (const char c : one.param.name)
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
  return name;
});

}  // namespace
}  // namespace ringlet::animation_formats_test
