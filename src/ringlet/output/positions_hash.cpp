// Implements output/positions_hash.h.
#include "ringlet/output/positions_hash.h"

#include <fmt/format.h>

namespace ringlet {

std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;  // the published offset basis
  for (char byte : bytes) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 0x100000001b3;  // the published prime
  }
  return hash;
}

std::string positionsHash(std::span<const Vec3f> positions) {
  static_assert(sizeof(Vec3f) == 3 * sizeof(float), "no padding may enter the hash");
  std::string_view bytes(reinterpret_cast<const char*>(positions.data()), positions.size_bytes());
  return fmt::format("{:016x}", fnv1a(bytes));
}

}  // namespace ringlet
