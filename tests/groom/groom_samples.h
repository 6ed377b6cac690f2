// Small grooms, and files in memory, for the tests of this folder.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "ringlet/groom/groom.h"

namespace ringlet::test {

inline std::span<const std::byte> bytesOf(const std::string& text) { return std::as_bytes(std::span(text)); }

/// Three strands of different lengths, with numbers that text formats like to spoil.
inline Groom awkwardGroom() {
  using Limits = std::numeric_limits<float>;
  Groom groom;
  groom.addStrand(std::vector<Vec3f>{{0.1f, -0.f, 1.f / 3}, {16777217.f, 1e-30f, -2.5f}});
  groom.addStrand(std::vector<Vec3f>{{Limits::max(), Limits::lowest(), Limits::min()},
                                     {Limits::denorm_min(), Limits::epsilon(), 3.14159274f},
                                     {0, 0, 0}});
  groom.addStrand(std::vector<Vec3f>{{1, 2, 3}, {1, 2, 3}, {4, 5, 6}, {-7, -8, -9}});
  return groom;
}

/// Random bit patterns of finite floats.
inline Groom randomGroom(std::uint32_t seed, int strandCount) {
  std::mt19937 random(seed);
  auto number = [&] {
    for (;;) {
      const auto bits = static_cast<std::uint32_t>(random());
      float value;
      std::memcpy(&value, &bits, sizeof value);
      if (std::isfinite(value)) return value;
    }
  };
  Groom groom;
  for (int s = 0; s < strandCount; ++s) {
    std::vector<Vec3f> strand;
    for (auto count = 2 + random() % 9; count > 0; --count) {
      const float x = number(), y = number(), z = number();
      strand.push_back({x, y, z});
    }
    groom.addStrand(strand);
  }
  return groom;
}

inline bool hasSameBits(const Groom& a, const Groom& b) {
  return a.firstPoint == b.firstPoint && a.points.size() == b.points.size() &&
         std::memcmp(a.points.data(), b.points.data(), a.points.size() * sizeof(Vec3f)) == 0;
}

/// What every groom that a reader returns must be: two finite particles or more in every strand.
inline bool isUsable(const Groom& groom) {
  if (groom.strandCount() == 0 || groom.firstPoint.front() != 0 ||
      groom.firstPoint.back() != groom.points.size())
    return false;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    if (groom.firstPoint[s + 1] < groom.firstPoint[s] + 2) return false;
  }
  for (Vec3f p : groom.points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
  }
  return true;
}

inline void writeText(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// How many files a folder holds: to see that no temporary one is left.
inline long fileCount(const std::filesystem::path& folder) {
  return static_cast<long>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace ringlet::test
