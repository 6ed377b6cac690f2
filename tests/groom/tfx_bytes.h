// TfxBytes: a .tfx file field by field, from AMD's description of its header; tests spoil one field each.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace ringlet::test {

/// By itself three strands of four points, 352 bytes.
struct TfxBytes {
  float version = 4;
  std::uint32_t strandCount = 3, pointsPerStrand = 4, positionsOffset = 160;
  std::array<std::uint32_t, 4> otherOffsets{};
  std::vector<float> positions = numbers(3 * 4);  // x, y, z, w
  std::string after{};

  static std::vector<float> numbers(std::size_t pointCount) {
    std::vector<float> values(4 * pointCount);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = 0.5f * static_cast<float>(i);
    return values;
  }
  static TfxBytes uniform(std::uint32_t strandCount, std::uint32_t pointsPerStrand) {
    return {.strandCount = strandCount,
            .pointsPerStrand = pointsPerStrand,
            .positions = numbers(std::size_t{strandCount} * pointsPerStrand)};
  }
  static void setU32(std::string& bytes, std::size_t offset, std::uint32_t value) {
    std::memcpy(bytes.data() + offset, &value, sizeof value);
  }

  std::string bytes() const {
    std::string out;
    auto append = [&](const auto& value) { out.append(reinterpret_cast<const char*>(&value), sizeof value); };
    append(version);
    for (std::uint32_t value : {strandCount, pointsPerStrand, positionsOffset}) append(value);
    for (std::uint32_t value : otherOffsets) append(value);
    out.resize(160, '\xaa');  // what is reserved may hold anything
    out.resize(std::max<std::size_t>(positionsOffset, 160), '\xff');
    for (float value : positions) append(value);
    return out + after;
  }
};

}  // namespace ringlet::test
