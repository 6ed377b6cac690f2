// Numbers of little-endian files, put together byte by byte: they may stand at any byte, and the machine's
// own byte order does not matter.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ringlet {

/// The number at `offset`, whose bytes the caller knows to be there.
inline std::uint32_t readU32(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(bytes[offset + i]) << (8 * i);
  return value;
}
inline std::uint32_t readU16(std::span<const std::byte> bytes, std::size_t offset) {
  const auto low = std::to_integer<std::uint32_t>(bytes[offset]);
  const auto high = std::to_integer<std::uint32_t>(bytes[offset + 1]);
  return low | high << 8;
}
inline std::uint64_t readU64(std::span<const std::byte> bytes, std::size_t offset) {
  return readU32(bytes, offset) | std::uint64_t{readU32(bytes, offset + 4)} << 32;
}
inline float readF32(std::span<const std::byte> bytes, std::size_t offset) {
  return std::bit_cast<float>(readU32(bytes, offset));
}
inline double readF64(std::span<const std::byte> bytes, std::size_t offset) {
  return std::bit_cast<double>(readU64(bytes, offset));
}

inline void appendU32(std::vector<std::byte>& bytes, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes.push_back(static_cast<std::byte>(value >> (8 * i) & 0xff));
}
inline void appendU64(std::vector<std::byte>& bytes, std::uint64_t value) {
  appendU32(bytes, static_cast<std::uint32_t>(value));
  appendU32(bytes, static_cast<std::uint32_t>(value >> 32));
}
inline void appendF32(std::vector<std::byte>& bytes, float value) {
  appendU32(bytes, std::bit_cast<std::uint32_t>(value));
}
inline void appendF64(std::vector<std::byte>& bytes, double value) {
  appendU64(bytes, std::bit_cast<std::uint64_t>(value));
}

}  // namespace ringlet
