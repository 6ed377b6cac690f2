// OpenEXR pictures: read back by a reader of this file's own, made from the format's document.
#include "ringlet/output/exr_file.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "ringlet/base/little_endian.h"
#include "ringlet/base/whole_file.h"
#include "tests/support/test_support.h"

namespace ringlet::exr_file_test {
namespace {

double valueOfHalf(std::uint32_t half) {
  const double sign = half & 0x8000 ? -1 : 1;
  const int exponent = static_cast<int>(half >> 10 & 31);
  const double digits = half & 1023;
  if (exponent == 0) return sign * std::ldexp(digits, -24);
  return sign * std::ldexp(1024 + digits, exponent - 25);
}

struct Read {
  int width = 0, height = 0;
  std::vector<double> pixels;  // red, green, blue
};

class Reader {
 public:
  explicit Reader(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}

  Read read() {
    EXPECT_EQ(number(), 20000630u);
    EXPECT_EQ(number(), 2u) << "a single part of scan lines";
    for (std::string name = text(); !name.empty(); name = text()) readAttribute(name);
    EXPECT_EQ(channels_, "BGR");
    EXPECT_EQ(compression_, 3);
    const int blocks = (read_.height + 15) / 16;
    std::vector<std::uint64_t> offsets;
    for (int b = 0; b < blocks; ++b, at_ += 8) offsets.push_back(readU64(bytes_, at_));
    read_.pixels.resize(3 * static_cast<std::size_t>(read_.width) * read_.height);
    for (int b = 0; b < blocks; ++b) readBlock(offsets[static_cast<std::size_t>(b)], 16 * b);
    return read_;
  }

 private:
  std::uint32_t number() { return readU32(bytes_, (at_ += 4) - 4); }
  std::string text() {
    std::string result;
    while (bytes_[at_] != std::byte{0}) result += static_cast<char>(bytes_[at_++]);
    ++at_;
    return result;
  }

  void readAttribute(const std::string& name) {
    text();  // its type
    const std::size_t end = number() + at_;
    if (name == "channels") {
      for (std::string channel = text(); !channel.empty(); channel = text()) {
        channels_ += channel;
        EXPECT_EQ(number(), 1u) << "halves";
        at_ += 12;
      }
    } else if (name == "compression") {
      compression_ = std::to_integer<int>(bytes_[at_]);
    } else if (name == "dataWindow") {
      read_.width = static_cast<int>(readU32(bytes_, at_ + 8)) + 1;
      read_.height = static_cast<int>(readU32(bytes_, at_ + 12)) + 1;
    }
    at_ = end;
  }

  void readBlock(std::size_t offset, int first) {
    at_ = offset;
    EXPECT_EQ(number(), static_cast<std::uint32_t>(first));
    const std::size_t size = number();
    const int lines = std::min(16, read_.height - first);
    std::vector<std::byte> raw(static_cast<std::size_t>(lines) * read_.width * 6);
    EXPECT_LE(size, raw.size()) << "a block that would be longer is stored as it is";
    if (size == raw.size()) {
      std::memcpy(raw.data(), bytes_.data() + at_, size);
    } else {
      std::vector<Bytef> parted(raw.size());
      uLongf length = parted.size();
      ASSERT_EQ(uncompress(parted.data(), &length, reinterpret_cast<const Bytef*>(bytes_.data() + at_), size),
                Z_OK);
      for (std::size_t i = 1; i < parted.size(); ++i)
        parted[i] = static_cast<Bytef>(parted[i - 1] + parted[i] - 128);
      for (std::size_t i = 0; i < raw.size(); ++i)
        raw[i] = std::byte{parted[i / 2 + (i % 2) * ((raw.size() + 1) / 2)]};
    }
    std::size_t from = 0;
    for (int y = first; y < first + lines; ++y)
      for (const int channel : {2, 1, 0})
        for (int x = 0; x < read_.width; ++x, from += 2)
          read_.pixels[3 * (static_cast<std::size_t>(y) * read_.width + x) + channel] =
              valueOfHalf(readU16(raw, from));
  }

  std::vector<std::byte> bytes_;
  std::size_t at_ = 0;
  std::string channels_;
  int compression_ = -1;
  Read read_;
};

// Smooth pictures are compressed, noise is stored as it is; more lines than a block has, odd sizes.
TEST(ExrFile, PicturesAreReadBack) {
  const auto folder = test::scratchFolder("exr_file");
  std::mt19937 random(7);
  for (const auto& [width, height, isNoise] :
       {std::tuple{1, 1, false}, {33, 16, false}, {64, 37, false}, {21, 35, true}}) {
    std::vector<float> pixels;
    for (int i = 0; i < 3 * width * height; ++i)
      pixels.push_back(isNoise ? std::ldexp(1 + static_cast<float>(random() % 1024) / 1024,
                                            static_cast<int>(random() % 28) - 13)
                               : static_cast<float>(i) / 64);
    ASSERT_TRUE(writeExr(folder / "a.exr", width, height, pixels));
    const Read found = Reader(*readWholeFile(folder / "a.exr")).read();
    EXPECT_EQ(found.width, width);
    EXPECT_EQ(found.height, height);
    for (std::size_t i = 0; i < pixels.size(); ++i)
      ASSERT_NEAR(found.pixels[i], pixels[i], 0.0005 * pixels[i]) << i;
    if (width == 64) {
      EXPECT_LT(std::filesystem::file_size(folder / "a.exr"), 6u * 64 * 37 / 2);
    }
  }
}

TEST(ExrFile, AFolderThatIsNotThereIsSaid) {
  const std::vector<float> pixel(3);
  EXPECT_FALSE(writeExr(test::scratchFolder("exr_file") / "none/a.exr", 1, 1, pixel));
}

}  // namespace
}  // namespace ringlet::exr_file_test
