// A fingerprint of positions: two runs that agree in every bit share it. FNV-1a, 64 bit (Fowler, Noll, Vo).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// The hash of raw bytes.
std::uint64_t fnv1a(std::string_view bytes);

/// The hash of the float bits of x, y, z in order, as 16 hexadecimal digits.
std::string positionsHash(std::span<const Vec3f> positions);

}  // namespace ringlet
