// Pictures that the program wrote, as numbers, for tests.
#pragma once

#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <vector>

namespace ringlet::test {

struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> bytes;  // red, green, blue
  bool operator==(const Image&) const = default;
};

inline Image readPng(const std::filesystem::path& path) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  Image image;
  EXPECT_TRUE(png_image_begin_read_from_file(&header, path.c_str())) << path << ": " << header.message;
  header.format = PNG_FORMAT_RGB;
  image.width = static_cast<int>(header.width);
  image.height = static_cast<int>(header.height);
  image.bytes.resize(PNG_IMAGE_SIZE(header));
  EXPECT_TRUE(png_image_finish_read(&header, nullptr, image.bytes.data(), 0, nullptr)) << header.message;
  return image;
}

// Pixels that two pictures of one size do not share.
inline int differing(const Image& a, const Image& b) {
  EXPECT_EQ(a.bytes.size(), b.bytes.size());
  int count = 0;
  for (std::size_t i = 0; i + 2 < std::min(a.bytes.size(), b.bytes.size()); i += 3)
    count += !std::equal(a.bytes.begin() + static_cast<std::ptrdiff_t>(i),
                         a.bytes.begin() + static_cast<std::ptrdiff_t>(i) + 3,
                         b.bytes.begin() + static_cast<std::ptrdiff_t>(i));
  return count;
}

inline int greatestDifference(const Image& a, const Image& b) {
  EXPECT_EQ(a.bytes.size(), b.bytes.size());
  int greatest = 0;
  for (std::size_t i = 0; i < std::min(a.bytes.size(), b.bytes.size()); ++i)
    greatest = std::max(greatest, std::abs(a.bytes[i] - b.bytes[i]));
  return greatest;
}

/// Root mean square of what two pictures of one size differ by, of 255.
inline double rmsDifference(const Image& a, const Image& b) {
  EXPECT_EQ(a.bytes.size(), b.bytes.size());
  double sum = 0;
  const std::size_t size = std::min(a.bytes.size(), b.bytes.size());
  for (std::size_t i = 0; i < size; ++i) sum += std::pow(a.bytes[i] - b.bytes[i], 2);
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(size, 1)));
}

}  // namespace ringlet::test
