// The layout of PC2 point caches, little-endian: "POINTCACHE2\0", int version 1, int points, float start
// frame, float frames a sample, int samples; then float x, y, z of each point of each sample.
#pragma once

#include <cstddef>
#include <string_view>

namespace ringlet {

inline constexpr std::string_view kPc2Magic{"POINTCACHE2\0", 12};
inline constexpr std::size_t kPc2HeaderBytes = 32, kPc2RateAt = 24, kPc2CountAt = 28, kPc2PointBytes = 12;

}  // namespace ringlet
