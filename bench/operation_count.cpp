// Implements bench/operation_count.h.
#include "bench/operation_count.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ringlet::bench {
namespace {

std::uint64_t operations = 0;

struct V {
  float value = 0;
  V(float x = 0) : value(x) {}
  V& operator+=(V b) { return *this = *this + b; }
  V operator-() const { return -value; }
  friend V operator+(V a, V b) { return counted(a.value + b.value); }
  friend V operator-(V a, V b) { return counted(a.value - b.value); }
  friend V operator*(V a, V b) { return counted(a.value * b.value); }
  friend V operator/(V a, V b) { return counted(a.value / b.value); }

 private:
  static V counted(float x) {
    ++operations;
    return x;
  }
};
V load(const Eight& x) { return x.lane[0]; }
void store(Eight& to, V x) { to.lane[0] = x.value; }
V all(float x) { return x; }
V max(V a, V b) { return std::max(a.value, b.value); }
V min(V a, V b) { return std::min(a.value, b.value); }
V wherePositive(V sign, V x) { return sign.value > 0 ? x : V(0); }
V inverse(V x) { return V(1) / x; }
V inverseSqrt(V x) {
  ++operations;
  return V(1) / std::sqrt(x.value);
}

#include "bench/sweep_arithmetic.inl"

// No arithmetic; where the strand is does not matter, as nothing branches on it.
void loadBlock(const SweepRun&, const Block& block, EdgeWork* work) {
  for (std::uint32_t i = 0; i < block.longest; ++i) {
    store3(work[i].position, {0.001f * static_cast<float>(i), 0, 0});
    store3(work[i].work + kVelocity, {});
  }
}
void storeBlock(const SweepRun&, const Block&, const EdgeWork*) {}

}  // namespace

std::uint64_t countOperations(const SweepRun& run, const Block& block) {
  std::vector<EdgeWork> work(block.longest);
  operations = 0;
  runStepsOf(run, block, work.data());
  return operations;
}

}  // namespace ringlet::bench
