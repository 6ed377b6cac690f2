// Implements bench/hand_sweeps.h.
#include "bench/hand_sweeps.h"

#if defined(__AVX2__) && defined(__FMA__)

#include <immintrin.h>

namespace ringlet::bench {
namespace {

using V = float __attribute__((vector_size(32)));

inline V load(const Eight& x) { return _mm256_load_ps(x.lane); }
inline void store(Eight& to, V x) { _mm256_store_ps(to.lane, x); }
inline V all(float x) { return _mm256_set1_ps(x); }
inline V max(V a, V b) { return _mm256_max_ps(a, b); }
inline V min(V a, V b) { return _mm256_min_ps(a, b); }

// Estimates of 12 bits and a Newton step: 22 to 23 bits.
inline V inverseSqrt(V x) {
  const V r = _mm256_rsqrt_ps(x);
  return r * (1.5f - 0.5f * (x * r * r));
}
inline V inverse(V x) {
  const V r = _mm256_rcp_ps(x);
  return r * (2.0f - x * r);
}

// x where `sign` is positive, else 0.
inline V wherePositive(V sign, V x) { return sign > 0.0f ? x : all(0); }

#include "bench/sweep_arithmetic.inl"

// 8 vec4 and x, y, z of each, both ways.
inline V3 gather(const layout::vec4* from, const std::uint32_t (&at)[kLanes]) {
  __m256 row[4];
  for (int k = 0; k < 4; ++k)
    row[k] = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(&from[at[k]].x)),
                                  _mm_load_ps(&from[at[k + 4]].x), 1);
  const __m256 xy01 = _mm256_unpacklo_ps(row[0], row[1]), zw01 = _mm256_unpackhi_ps(row[0], row[1]);
  const __m256 xy23 = _mm256_unpacklo_ps(row[2], row[3]), zw23 = _mm256_unpackhi_ps(row[2], row[3]);
  return {_mm256_shuffle_ps(xy01, xy23, 0x44), _mm256_shuffle_ps(xy01, xy23, 0xee),
          _mm256_shuffle_ps(zw01, zw23, 0x44)};
}
inline void scatter(layout::vec4* to, const std::uint32_t (&at)[kLanes], std::uint32_t lanes, V3 a) {
  const __m256 zero = _mm256_setzero_ps();
  const __m256 xyLow = _mm256_unpacklo_ps(a.x, a.y), xyHigh = _mm256_unpackhi_ps(a.x, a.y);
  const __m256 zLow = _mm256_unpacklo_ps(a.z, zero), zHigh = _mm256_unpackhi_ps(a.z, zero);
  const __m256 row[4] = {_mm256_shuffle_ps(xyLow, zLow, 0x44), _mm256_shuffle_ps(xyLow, zLow, 0xee),
                         _mm256_shuffle_ps(xyHigh, zHigh, 0x44), _mm256_shuffle_ps(xyHigh, zHigh, 0xee)};
  for (std::uint32_t k = 0; k < 4; ++k) {
    if (lanes & (1u << k)) _mm_store_ps(&to[at[k]].x, _mm256_castps256_ps128(row[k]));
    if (lanes & (16u << k)) _mm_store_ps(&to[at[k + 4]].x, _mm256_extractf128_ps(row[k], 1));
  }
}

void loadBlock(const SweepRun& run, const Block& block, EdgeWork* work) {
  for (std::uint32_t i = 0; i < block.longest; ++i) {
    std::uint32_t at[kLanes];
    for (std::size_t l = 0; l < kLanes; ++l)
      at[l] = block.firstParticle[l] + (i < block.particleCount[l] ? i : block.particleCount[l] - 1);
    store3(work[i].position, gather(run.positions, at));
    store3(work[i].work + kVelocity, gather(run.velocities, at));
  }
}

void storeBlock(const SweepRun& run, const Block& block, const EdgeWork* work) {
  for (std::uint32_t i = 0; i < block.longest; ++i) {
    std::uint32_t at[kLanes], lanes = 0;
    for (std::size_t l = 0; l < kLanes; ++l) {
      at[l] = block.firstParticle[l] + i;
      lanes |= i < block.particleCount[l] ? 1u << l : 0u;
    }
    scatter(run.positions, at, lanes, load(work[i].position));
    scatter(run.velocities, at, lanes, load3(work[i].work + kVelocity));
  }
}

}  // namespace

float runBlock(const SweepRun& run, const Block& block, EdgeWork* work) {
  const V longest = runStepsOf(run, block, work);
  float most = 0;
  for (std::size_t l = 0; l < kLanes; ++l) most = longest[l] > most ? longest[l] : most;
  return most;
}

bool canSweep() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }
const char* sweepFlags() { return RINGLET_SWEEP_FLAGS; }

}  // namespace ringlet::bench

#else

namespace ringlet::bench {
float runBlock(const SweepRun&, const Block&, EdgeWork*) { return 0; }
bool canSweep() { return false; }
const char* sweepFlags() { return "not compiled: this compiler has no AVX2"; }
}  // namespace ringlet::bench

#endif
