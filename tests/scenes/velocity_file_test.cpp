// Grids of velocities from NumPy files, as bytes; what numpy.save itself writes is read in tests/python.
#include "ringlet/scenes/frames/velocity_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ringlet/base/little_endian.h"

namespace ringlet::velocity_file_test {
namespace {

struct Array {
  const char* type = "<f4";
  const char* shape = "(2, 3, 4, 3)";
  bool isFortran = false;
  int version = 1;
};

std::vector<std::byte> bytesOf(const std::string& text) {
  std::vector<std::byte> bytes;
  for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
  return bytes;
}

// The number at node (x, y, z), component c.
double valueAt(int x, int y, int z, int c) { return 1000 * x + 100 * y + 10 * z + c; }

std::vector<std::byte> fileOf(const Array& array) {
  std::string header = fmt::format("{{'descr': '{}', 'fortran_order': {}, 'shape': {}, }}", array.type,
                                   array.isFortran ? "True" : "False", array.shape);
  header += std::string(64 - header.size() % 64, ' ') + "\n";
  std::vector<std::byte> bytes = bytesOf("\x93NUMPY");
  bytes.push_back(static_cast<std::byte>(array.version));
  bytes.push_back(std::byte{0});
  const auto length = static_cast<std::uint32_t>(header.size());
  if (array.version >= 2) {
    appendU32(bytes, length);
  } else {
    bytes.push_back(static_cast<std::byte>(length & 0xff));
    bytes.push_back(static_cast<std::byte>(length >> 8));
  }
  for (const std::byte b : bytesOf(header)) bytes.push_back(b);
  const auto append = [&](double v) {
    if (std::string(array.type) == "<f8") {
      appendF64(bytes, v);
    } else {
      appendF32(bytes, static_cast<float>(v));
    }
  };
  if (array.isFortran) {
    for (int c = 0; c < 3; ++c)
      for (int z = 0; z < 4; ++z)
        for (int y = 0; y < 3; ++y)
          for (int x = 0; x < 2; ++x) append(valueAt(x, y, z, c));
  } else {
    for (int x = 0; x < 2; ++x)
      for (int y = 0; y < 3; ++y)
        for (int z = 0; z < 4; ++z)
          for (int c = 0; c < 3; ++c) append(valueAt(x, y, z, c));
  }
  return bytes;
}

TEST(VelocityFile, EveryFormIsRead) {
  for (const char* type : {"<f4", "<f8"}) {
    for (const bool isFortran : {false, true}) {
      for (const int version : {1, 2, 3}) {
        SCOPED_TRACE(fmt::format("{} {} {}", type, isFortran, version));
        const auto grid =
            parseVelocities(fileOf({.type = type, .isFortran = isFortran, .version = version}), 0.25);
        ASSERT_TRUE(grid) << grid.error().message;
        EXPECT_EQ(grid->nodes, (std::array<std::uint32_t, 3>{2, 3, 4}));
        EXPECT_EQ(grid->cell, 0.25);
        ASSERT_EQ(grid->velocities.size(), 24u);
        for (int x = 0; x < 2; ++x)
          for (int y = 0; y < 3; ++y)
            for (int z = 0; z < 4; ++z) {
              const Vec3f v = grid->velocities[static_cast<std::size_t>((z * 3 + y) * 2 + x)];
              EXPECT_EQ(v.x, valueAt(x, y, z, 0));
              EXPECT_EQ(v.y, valueAt(x, y, z, 1));
              EXPECT_EQ(v.z, valueAt(x, y, z, 2));
            }
      }
    }
  }
}

TEST(VelocityFile, OtherArraysAreRefused) {
  const struct {
    Array array;
    const char* message;
  } kCases[] = {
      {{.type = "<i4"}, "expected '<f4' or '<f8'"},
      {{.type = ">f4"}, "expected '<f4' or '<f8'"},
      {{.shape = "(2, 3, 4)"}, "expected (x, y, z, 3)"},
      {{.shape = "(2, 3, 4, 4)"}, "expected (x, y, z, 3)"},
      {{.shape = "(2, 3, 4, 3, 1)"}, "expected (x, y, z, 3)"},
      {{.shape = "(1, 6, 4, 3)"}, "found 1 nodes on a side; expected 2 to 4096"},
      {{.shape = "(2, 3, 5, 3)"}, "the file ends before its 30 velocities do"},
      {{.shape = "(4000, 4000, 4000, 3)"}, "the file ends before"},
      {{.shape = "(99999999999999999999, 3, 4, 3)"}, "expected (x, y, z, 3)"},
  };
  for (const auto& c : kCases) {
    const auto refused = parseVelocities(fileOf(c.array), 1);
    ASSERT_FALSE(refused) << c.message;
    EXPECT_NE(refused.error().message.find(c.message), std::string::npos) << refused.error().message;
  }
  EXPECT_FALSE(parseVelocities(bytesOf("P6 2 2 255 not NumPy"), 1));
  std::vector<std::byte> infinite = fileOf({});
  infinite.resize(infinite.size() - 4);
  appendF32(infinite, INFINITY);
  const auto refused = parseVelocities(infinite, 1);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "the velocity at (1, 2, 3) is not finite");
}

// Cut anywhere, or with bytes changed: read or refused, never more.
TEST(VelocityFile, SpoiltFilesAreReadOrRefused) {
  const std::vector<std::byte> whole = fileOf({});
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(parseVelocities(std::span(whole).first(size), 1)) << size;
  std::mt19937 random(7);
  for (int trial = 0; trial < 5000; ++trial) {
    std::vector<std::byte> spoilt = whole;
    for (int k = 0; k < 3; ++k) spoilt[random() % 140] = static_cast<std::byte>(random() & 0xff);
    (void)parseVelocities(spoilt, 1);
  }
}

}  // namespace
}  // namespace ringlet::velocity_file_test
