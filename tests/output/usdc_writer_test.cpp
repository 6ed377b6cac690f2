// hair.usdc: what a crate of ours holds, read by the reader of other programs' crates; its size; velocities
// and transforms against closed forms.
#include "ringlet/output/usd/usdc_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "ringlet/groom/usd/usd_file.h"
#include "ringlet/groom/usd/usd_layer.h"
#include "ringlet/groom/usd/usdc_file.h"
#include "ringlet/groom/usd/usdc_format.h"
#include "ringlet/output/usd/usdc_reader.h"
#include "tests/support/test_support.h"

namespace ringlet::usdc_writer_test {
namespace {

namespace fs = std::filesystem;
using test::scratchFolder;

Groom smallGroom() {
  Groom groom;
  groom.addStrand(std::vector<Vec3f>{{0, 0, 0}, {0, -1, 0.25f}, {0.5f, -2, 0}});
  groom.addStrand(std::vector<Vec3f>{{1, 0, 0}, {1, -1.5f, 0}});
  return groom;
}
constexpr std::size_t kPoints = 5;

// A frame of the groom, moved by a law of time.
using Law = std::function<double(double frame)>;
std::vector<Vec3f> movedBy(const Groom& groom, double by) {
  auto points = groom.points;
  for (Vec3f& p : points) p.x += static_cast<float>(by);
  return points;
}

// A crate as its head says it, and the bytes behind it.
struct Crate {
  std::vector<std::byte> bytes;
  UsdLayer layer;  // of samples where they are

  const UsdPrim& hair() const { return layer.prims.front(); }
  const UsdAttribute& attribute(std::string_view name) const {
    for (const UsdAttribute& attribute : hair().attributes)
      if (attribute.name == name) return attribute;
    throw std::runtime_error("no attribute " + std::string(name));
  }
  std::size_t sampleCount(std::string_view name) const { return attribute(name).places.size(); }
  static bool isBlock(std::uint64_t rep) { return rep >> 48 == (0x4000 | 51); }
  // Of frame k, from 1: vectors of three floats, by hand.
  std::vector<Vec3f> vectors(std::string_view name, int frame) const {
    const std::uint64_t rep = attribute(name).places.at(static_cast<std::size_t>(frame) - 1).rep;
    EXPECT_EQ(rep >> 48, 0x8000u | 24u) << name;
    const std::size_t at = rep & 0xffffffffffff;
    std::uint64_t count = 0;
    std::memcpy(&count, bytes.data() + at, 8);
    std::vector<Vec3f> values(count);
    std::memcpy(values.data(), bytes.data() + at + 8, 12 * count);
    return values;
  }
};

Crate crateOf(const fs::path& path) {
  const std::string text = test::readText(path);
  Crate crate;
  crate.bytes.resize(text.size());
  std::memcpy(crate.bytes.data(), text.data(), text.size());
  auto layer = readUsdc(crate.bytes, path.string(), {.keepsPlaces = true});
  EXPECT_TRUE(layer) << layer.error().message;
  if (layer) crate.layer = std::move(*layer);
  return crate;
}

// Writes so many frames of a law; `announced` of them were.
fs::path write(const fs::path& folder, const AnimationOptions& options, int frames, const Law& law,
               bool finishes = true) {
  const fs::path path = folder / "hair.usdc";
  const Groom groom = smallGroom();
  auto writer = UsdcWriter::create(path, groom, options);
  EXPECT_TRUE(writer);
  for (int frame = 1; frame <= frames; ++frame) EXPECT_TRUE(writer->addFrame(movedBy(groom, law(frame))));
  if (!finishes) return path.string() + ".partial";
  EXPECT_TRUE(writer->finish());
  return path;
}

TEST(UsdcWriter, SaysWhatReadersNeed) {
  const fs::path path = write(scratchFolder("usdc_all"),
                              {.framesPerSecond = 23.976,
                               .metresPerUnit = 0.01,
                               .up = UpAxis::z,
                               .diameter = 0.5f,
                               .frameCount = 4,
                               .usd = {.ids = true, .rest = true}},
                              4, [](double frame) { return frame; });
  const Crate crate = crateOf(path);
  EXPECT_EQ(crate.layer.upAxis, "Z");
  EXPECT_EQ(crate.layer.metresPerUnit, 0.01);
  EXPECT_EQ(crate.layer.timeCodesPerSecond, 23.976);
  ASSERT_EQ(crate.layer.prims.size(), 1u);
  EXPECT_EQ(crate.hair().name, "Hair");
  EXPECT_EQ(crate.hair().type, "BasisCurves");
  EXPECT_EQ(crate.attribute("curveVertexCounts").value.numbers, (std::vector<double>{3, 2}));
  EXPECT_EQ(crate.attribute("type").value.texts, std::vector<std::string_view>{"linear"});
  EXPECT_EQ(crate.attribute("wrap").value.texts, std::vector<std::string_view>{"nonperiodic"});
  EXPECT_EQ(crate.attribute("widths").value.numbers, std::vector<double>{0.5});
  ASSERT_EQ(crate.sampleCount("points"), 4u);
  for (int frame = 1; frame <= 4; ++frame) {
    EXPECT_EQ(crate.attribute("points").places[static_cast<std::size_t>(frame) - 1].time, frame);
    EXPECT_EQ(crate.vectors("points", frame), movedBy(smallGroom(), frame));
    // What the points fill, and half a diameter.
    const std::vector<Vec3f> extent{{-0.25f + static_cast<float>(frame), -2.25f, -0.25f},
                                    {1.25f + static_cast<float>(frame), 0.25f, 0.5f}};
    EXPECT_EQ(crate.vectors("extent", frame), extent);
  }
}

// As a groom it is its first frame.
TEST(UsdcWriter, IsAGroomAsWell) {
  const fs::path path = write(scratchFolder("usdc_groom"), {.metresPerUnit = 0.1, .frameCount = 2}, 2,
                              [](double frame) { return frame; });
  const Crate crate = crateOf(path);
  const auto groom = readUsd(crate.bytes, path);
  ASSERT_TRUE(groom) << groom.error().message;
  EXPECT_EQ(groom->groom.points, movedBy(smallGroom(), 1));
  EXPECT_EQ(groom->groom.firstPoint, smallGroom().firstPoint);
  EXPECT_EQ(groom->groom.metresPerUnit, 0.1);
}

// 12 bytes a point and frame, 40 bytes a frame, and of the head what does not depend on points but for the
// counts and 8 bytes a frame of each of what moves and the times.
TEST(UsdcWriter, TakesTwelveBytesAPoint) {
  const fs::path folder = scratchFolder("usdc_size");
  const auto bytesOf = [&](int frames) {
    return fs::file_size(write(folder, {.frameCount = frames}, frames, [](double) { return 0; }));
  };
  const auto padded = [](std::uint64_t bytes) { return (bytes + 7) / 8 * 8; };
  EXPECT_EQ(bytesOf(200) - bytesOf(100), 100 * (padded(8 + 12 * kPoints) + 8 + 24 + 3 * 8));
}

TEST(UsdcWriter, UnfinishedFramesHaveNoValue) {
  const fs::path path = write(
      scratchFolder("usdc_open"), {.frameCount = 5, .usd = {.velocities = true}}, 3,
      [](double frame) { return frame; }, false);
  const Crate crate = crateOf(path);
  for (const char* name : {"points", "extent", "velocities"}) {
    ASSERT_EQ(crate.sampleCount(name), 5u);
    const int whole = name == std::string("velocities") ? 2 : 3;
    for (int frame = 1; frame <= 5; ++frame) {
      EXPECT_EQ(Crate::isBlock(crate.attribute(name).places[static_cast<std::size_t>(frame) - 1].rep),
                frame > whole)
          << name << " " << frame;
    }
  }
  EXPECT_EQ(fs::file_size(path) % 8, 0u);
}

// Of a run that ended early nothing is left of the frames that did not come.
TEST(UsdcWriter, AFinishedFileHasSamplesOfItsFramesOnly) {
  const fs::path path = write(scratchFolder("usdc_fewer"), {.frameCount = 5, .usd = {.velocities = true}}, 3,
                              [](double frame) { return frame; });
  const Crate crate = crateOf(path);
  for (const char* name : {"points", "extent", "velocities"}) {
    ASSERT_EQ(crate.sampleCount(name), 3u) << name;
    for (const UsdSamplePlace& place : crate.attribute(name).places)
      EXPECT_FALSE(Crate::isBlock(place.rep)) << name;
  }
}

// Velocities are differences of what was written, in units a second: of an even motion its speed, of a
// parabola its slope, to the rounding of what was added to the points.
TEST(UsdcWriter, VelocitiesAreThoseOfTheMotion) {
  const double fps = 24;
  const auto velocitiesOf = [&](int frames, const Law& law) {
    const Crate crate =
        crateOf(write(scratchFolder("usdc_velocities"),
                      {.framesPerSecond = fps, .frameCount = 8, .usd = {.velocities = true}}, frames, law));
    std::vector<double> speeds;
    for (int frame = 1; frame <= frames; ++frame) {
      const auto velocities = crate.vectors("velocities", frame);
      EXPECT_EQ(velocities.size(), kPoints);
      for (const Vec3f v : velocities) {
        EXPECT_EQ(v.x, velocities.front().x);
        EXPECT_EQ(v.y, 0);
        EXPECT_EQ(v.z, 0);
      }
      speeds.push_back(velocities.front().x);
    }
    return speeds;
  };
  // Steps of 1/4 and 1/64 unit are exact in float32.
  EXPECT_EQ(velocitiesOf(4, [](double frame) { return 0.25 * frame; }), (std::vector<double>{6, 6, 6, 6}));
  EXPECT_EQ(velocitiesOf(5, [](double frame) { return frame * frame / 64; }),
            (std::vector<double>{fps * 3 / 64, fps * 4 / 64, fps * 6 / 64, fps * 8 / 64, fps * 9 / 64}));
  EXPECT_EQ(velocitiesOf(1, [](double) { return 1; }), std::vector<double>{0});
}

// Points stay where they are, seen from a head that turns and moves; and the transform brings them back.
TEST(UsdcWriter, TheHeadsMotionIsApart) {
  const fs::path path = scratchFolder("usdc_head") / "hair.usdc";
  const Groom groom = smallGroom();
  auto writer = UsdcWriter::create(
      path, groom, {.frameCount = 10, .usd = {.velocities = true, .head = UsdHead::transform}});
  ASSERT_TRUE(writer);
  std::vector<std::vector<Vec3f>> world;
  for (int frame = 1; frame <= 10; ++frame) {
    const double angle = 0.5 * frame;
    const UsdTransform head{{Vec3d{std::cos(angle), 0, -std::sin(angle)}, Vec3d{0, 1, 0},
                             Vec3d{std::sin(angle), 0, std::cos(angle)}},
                            {3.0 * frame, 1, 0}};
    world.emplace_back();
    for (const Vec3f p : groom.points) world.back().push_back(Vec3f(head(Vec3d(p))));
    ASSERT_TRUE(writer->addFrame(world.back(), head));
  }
  ASSERT_TRUE(writer->finish());

  const Crate crate = crateOf(path);
  EXPECT_EQ(crate.attribute("xformOpOrder").value.texts, std::vector<std::string_view>{"xformOp:transform"});
  auto reader = UsdcReader::open(path);
  ASSERT_TRUE(reader) << reader.error().message;
  std::vector<Vec3f> points;
  for (int frame = 1; frame <= 10; ++frame) {
    // Coordinates of up to 33 were rounded to float32 in the world.
    EXPECT_LT(test::farthestApart(crate.vectors("points", frame), groom.points), 64 * 0x1p-24 * 2);
    for (const Vec3f v : crate.vectors("velocities", frame)) EXPECT_LT(length(v), 24 * 64 * 0x1p-24 * 4);
    ASSERT_TRUE(reader->readFrame(frame, points));
    EXPECT_LT(test::farthestApart(points, world[static_cast<std::size_t>(frame) - 1]), 64 * 0x1p-24 * 4);
  }
}

// Where the next frame stands does not depend on those before: any is read at once, in any order.
TEST(UsdcWriter, AnyFrameIsReadAtOnce) {
  const fs::path path =
      write(scratchFolder("usdc_any"), {.frameCount = 20}, 20, [](double frame) { return frame; });
  auto reader = UsdcReader::open(path);
  ASSERT_TRUE(reader);
  std::vector<Vec3f> points;
  for (const int frame : {20, 1, 13, 13, 2}) {
    ASSERT_TRUE(reader->readFrame(frame, points));
    EXPECT_EQ(points, movedBy(smallGroom(), frame));
  }
}

// A frame is one that has all of its values: of a file in which the last has points and no transform, or a
// transform and no points, the frames before it.
TEST(UsdcReader, AFrameNeedsAllItsValues) {
  const fs::path path = scratchFolder("usdc_half") / "hair.usdc";
  auto writer =
      UsdcWriter::create(path, smallGroom(), {.frameCount = 3, .usd = {.head = UsdHead::transform}});
  ASSERT_TRUE(writer);
  for (int frame = 1; frame <= 2; ++frame) ASSERT_TRUE(writer->addFrame(movedBy(smallGroom(), frame)));
  const fs::path partial = path.string() + ".partial";
  const Crate crate = crateOf(partial);
  for (const char* name : {"points", "xformOp:transform"}) {
    for (const int kept : {0, 1}) {
      SCOPED_TRACE(testing::Message() << kept << " of " << name);
      std::vector<std::byte> bytes = crate.bytes;
      for (std::size_t frame = static_cast<std::size_t>(kept); frame < 2; ++frame) {
        const std::uint64_t rep = crate.attribute(name).places[frame].rep;
        const auto at = std::ranges::search(bytes, std::as_bytes(std::span(&rep, 1)));
        ASSERT_FALSE(at.empty());
        std::memcpy(&*at.begin(), &usdc::kBlock.bits, 8);
      }
      const fs::path torn = path.parent_path() / "torn.usdc";
      std::ofstream(torn, std::ios::binary)
          .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
      auto reader = UsdcReader::open(torn);
      ASSERT_TRUE(reader) << reader.error().message;
      EXPECT_EQ(reader->frameCount(), kept);
      EXPECT_TRUE(reader->warnings().empty());
      std::vector<Vec3f> points;
      for (int frame = 1; frame <= kept; ++frame) {
        ASSERT_TRUE(reader->readFrame(frame, points));
        EXPECT_EQ(points, movedBy(smallGroom(), frame));
      }
    }
  }
}

TEST(UsdcReader, RefusesCratesOfOthers) {
  const fs::path path = write(scratchFolder("usdc_other"), {.frameCount = 1}, 1, [](double) { return 0; });
  std::string text = test::readText(path);
  text[88] = 'r';  // of "Ringlet frames 1"
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
  const auto reader = UsdcReader::open(path);
  ASSERT_FALSE(reader);
  EXPECT_NE(reader.error().message.find("only animations that Ringlet wrote"), std::string::npos)
      << reader.error().message;
  EXPECT_FALSE(UsdcReader::isOurs(path));
  EXPECT_FALSE(UsdcReader::isOurs(path.string() + "no"));
}

}  // namespace
}  // namespace ringlet::usdc_writer_test
