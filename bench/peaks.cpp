// Implements bench/peaks.h.
#include "bench/peaks.h"

#include <algorithm>
#include <cstring>
#include <ctime>

#include "bench/clocks.h"

namespace ringlet::bench {
namespace {

// Of this thread: the peak is the machine's, not what other programs leave of it.
double threadCpuSeconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

#if defined(__x86_64__) && defined(__GNUC__)
using Eight = float __attribute__((vector_size(32)));
constexpr int kChains =
    12;  // 4 cycles of latency, 2 a cycle: 8 would do; 12 and two constants fit 16 registers
constexpr long kTurns = 20000;

bool hasMultiplyAdd() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }

// In one instruction each, by hand: compilers reorder and fuse what they like.
__attribute__((target("avx2,fma"))) double multiplyAdds() {
  Eight x[kChains];
  for (int c = 0; c < kChains; ++c) x[c] = Eight{} + static_cast<float>(c);
  const Eight a = Eight{} + 0.999f, b = Eight{} + 0.001f;
  for (long turn = 0; turn < kTurns; ++turn) {
#pragma GCC unroll 12
    for (int c = 0; c < kChains; ++c) asm volatile("vfmadd213ps %2, %1, %0" : "+x"(x[c]) : "x"(a), "x"(b));
  }
  return 2.0 * 8 * kChains * kTurns;
}
#else
bool hasMultiplyAdd() { return false; }
double multiplyAdds() { return 0; }
#endif

}  // namespace

double multiplyAddPeak(ThreadTeam& team, double seconds) {
  if (!hasMultiplyAdd()) return 0;
  std::vector<double> rates(team.size(), 0.0);
  team.run([&](unsigned thread) {
    const double start = threadCpuSeconds();
    double operations = 0, now = start;
    while (now < start + seconds) {
      operations += multiplyAdds();
      now = threadCpuSeconds();
    }
    rates[thread] = operations / (now - start);
  });
  double sum = 0;
  for (const double rate : rates) sum += rate;
  return sum;
}

CopyPeak::CopyPeak(std::size_t bytes) : from_(bytes, 1), to_(bytes, 0) {}

double CopyPeak::measure(ThreadTeam& team) {
  const std::size_t share = from_.size() / team.size();
  const double start = wallSeconds();
  team.run([&](unsigned thread) {
    std::memcpy(to_.data() + thread * share, from_.data() + thread * share, share);
  });
  return 2.0 * static_cast<double>(share * team.size()) / (wallSeconds() - start);
}

}  // namespace ringlet::bench
