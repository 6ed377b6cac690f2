// NumberRange: the allowed values of a number.
#pragma once

namespace ringlet {

struct NumberRange {
  double low = 0, high = 0;
  bool contains(double value) const { return value >= low && value <= high; }  // NaN is in none
  bool operator==(const NumberRange&) const = default;
};

inline constexpr NumberRange kShareRange{0, 1}, kSeedRange{0, 4294967295.0};

}  // namespace ringlet
