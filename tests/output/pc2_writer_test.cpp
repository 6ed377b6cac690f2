// Point caches: their bytes, by hand, and the strands beside them.
#include "ringlet/output/pc2_writer.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "ringlet/groom/groom_file.h"
#include "tests/support/test_support.h"

namespace ringlet::pc2_writer_test {
namespace {

namespace fs = std::filesystem;

Groom groomAt(int frame) {
  Groom groom;
  groom.addStrand(std::vector<Vec3f>{{0, 0, static_cast<float>(frame)}, {0, -1, 0.1f}, {0.5f, -2, 0}});
  groom.addStrand(std::vector<Vec3f>{{1, 0, 0}, {1, -1.5f, static_cast<float>(frame) / 3}});
  return groom;
}

template <class Number>
Number at(const std::string& text, std::size_t offset) {
  Number value{};
  std::memcpy(&value, text.data() + offset, sizeof value);
  return value;
}

void expectFrames(const std::string& text, int frames) {
  ASSERT_EQ(text.size(), 32u + 60u * static_cast<std::size_t>(frames));
  EXPECT_EQ(text.substr(0, 12), std::string("POINTCACHE2\0", 12));
  EXPECT_EQ(at<std::int32_t>(text, 12), 1);
  EXPECT_EQ(at<std::int32_t>(text, 16), 5);
  EXPECT_EQ(at<float>(text, 20), 1);
  EXPECT_EQ(at<float>(text, 24), 1);
  EXPECT_EQ(at<std::int32_t>(text, 28), frames);
  for (int frame = 1; frame <= frames; ++frame) {
    std::vector<Vec3f> points(5);
    std::memcpy(points.data(), text.data() + 32 + 60 * (frame - 1), 60);
    EXPECT_EQ(points, groomAt(frame).points) << frame;
  }
}

TEST(Pc2Writer, IsWholeAfterEveryFrame) {
  const fs::path path = test::scratchFolder("pc2") / "hair.pc2", partial = path.string() + ".partial";
  auto writer = Pc2Writer::resume(path, groomAt(0), {.frameCount = 4}, 0);
  ASSERT_TRUE(writer) << writer.error().message;
  for (int frame = 1; frame <= 4; ++frame) {
    ASSERT_TRUE(writer->addFrame(groomAt(frame).points));
    expectFrames(test::readText(partial), frame);
  }
  ASSERT_TRUE(writer->finish());
  expectFrames(test::readText(path), 4);
  const auto strands = readGroom(fs::path(path).replace_extension(".obj"));
  ASSERT_TRUE(strands) << strands.error().message;
  EXPECT_EQ(strands->groom.points, groomAt(1).points);
  EXPECT_EQ(strands->groom.firstPoint, groomAt(1).firstPoint);
}

TEST(Pc2Writer, IsGoneOnWithToTheSameBytes) {
  const fs::path path = test::scratchFolder("pc2_resume") / "hair.pc2", partial = path.string() + ".partial";
  const auto write = [&](int from, int to) {
    auto writer = Pc2Writer::resume(path, groomAt(0), {.frameCount = 4}, from);
    if (!writer) return Status{writer.error()};
    for (int frame = from + 1; frame <= to; ++frame) EXPECT_TRUE(writer->addFrame(groomAt(frame).points));
    return to == 4 ? writer->finish() : Status{};
  };
  for (int from = 1; from <= 3; ++from) {
    ASSERT_TRUE(write(0, 3));
    ASSERT_TRUE(write(from, from));
    expectFrames(test::readText(partial), from);  // it says no more than it still has
    ASSERT_TRUE(write(from, 4));
    expectFrames(test::readText(path), 4);
    fs::remove(path);
  }
  ASSERT_TRUE(write(0, 2));
  EXPECT_FALSE(write(3, 4)) << "it has two";
  expectFrames(test::readText(partial), 2);
  std::ofstream(partial, std::ios::binary | std::ios::trunc) << std::string(200, 'x');
  EXPECT_FALSE(write(1, 4)) << "it is none";
}

}  // namespace
}  // namespace ringlet::pc2_writer_test
