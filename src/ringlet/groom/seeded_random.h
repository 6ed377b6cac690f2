// SeededRandom: the same numbers for a seed on every machine, unlike the distributions of the standard
// library.
#pragma once

#include <cstdint>

namespace ringlet {

/// SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
class SeededRandom {
 public:
  /// Streams of one seed are independent: one per strand keeps a strand as it is when others are added.
  SeededRandom(std::uint64_t seed, std::uint64_t stream) : state_(mix(seed) ^ mix(~stream)) {}

  /// Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  /// Uniform in [low, high).
  double between(double low, double high) { return low + (high - low) * uniform(); }

 private:
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t next() { return mix(state_ += 0x9e3779b97f4a7c15u); }  // 2^64 over the golden ratio

  std::uint64_t state_;
};

}  // namespace ringlet
