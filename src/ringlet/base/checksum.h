// The checksum of bytes that a program keeps and reads back later: of checkpoints.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace ringlet {

/// FNV-1a over words of 8 bytes, each folded (Fowler, Noll, Vo hash single bytes, at an eighth of the speed).
/// A change within one word always shows, any other but for one in 2^64. It guards against damage and not
/// against intent. Words have the machine's byte order, as an Archive has.
inline std::uint64_t checksum64(std::span<const std::byte> bytes) {
  std::uint64_t hash = 0xcbf29ce484222325 ^ bytes.size();  // the published offset basis
  while (!bytes.empty()) {
    std::uint64_t word = 0;
    const std::size_t count = std::min(bytes.size(), sizeof word);
    std::memcpy(&word, bytes.data(), count);
    hash = (hash ^ word) * 0x100000001b3;  // the published prime
    hash ^= hash >> 32;
    bytes = bytes.subspan(count);
  }
  return hash;
}

}  // namespace ringlet
