// Half precision (IEEE 754 binary16): from float, as shaders unpack it, and back.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace ringlet {

/// Rounds to the nearest half, ties to even; numbers that are too large become infinity.
inline std::uint16_t halfBits(float value) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(value), sign = bits >> 16 & 0x8000u;
  const std::uint32_t magnitude = bits & 0x7fffffffu;
  if (magnitude > 0x7f800000u) return static_cast<std::uint16_t>(sign | 0x7e00u);   // not a number
  if (magnitude >= 0x477ff000u) return static_cast<std::uint16_t>(sign | 0x7c00u);  // 65,520 and more
  // A normal half keeps 10 of the 23 bits behind the point, a subnormal one those above 2^-24.
  const std::uint32_t exponent = magnitude >> 23;
  const bool isNormal = exponent >= 113;
  const std::uint32_t dropped = isNormal ? 13 : 126 - exponent;
  if (dropped > 25) return static_cast<std::uint16_t>(sign);
  const std::uint32_t digits = isNormal ? magnitude - (112u << 23) : (magnitude & 0x7fffffu) | 0x800000u;
  const std::uint32_t half = digits >> dropped, rest = digits & ((1u << dropped) - 1),
                      tie = 1u << (dropped - 1);
  return static_cast<std::uint16_t>(sign | (half + (rest > tie || (rest == tie && (half & 1)) ? 1 : 0)));
}

/// Exactly the number that a half's 16 bits stand for.
inline double halfValue(std::uint32_t bits) {
  const std::uint32_t exponent = bits >> 10 & 31, digits = bits & 1023;
  const double size = exponent == 31  ? (digits ? std::nan("") : HUGE_VAL)
                      : exponent == 0 ? std::ldexp(digits, -24)
                                      : std::ldexp(1024 + digits, static_cast<int>(exponent) - 25);
  return bits >> 15 & 1 ? -size : size;
}

}  // namespace ringlet
