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
  // By name: of an array the compiler would keep every chain in memory, at half the rate.
  Eight x0{}, x1{}, x2{}, x3{}, x4{}, x5{}, x6{}, x7{}, x8{}, x9{}, x10{}, x11{};
  const Eight a = Eight{} + 0.999f, b = Eight{} + 0.001f;
  const auto next = [&](Eight & x) __attribute__((always_inline, target("avx2,fma"))) {
    asm volatile("vfmadd213ps %2, %1, %0" : "+x"(x) : "x"(a), "x"(b));
  };
  for (long turn = 0; turn < kTurns; ++turn) {
    next(x0), next(x1), next(x2), next(x3), next(x4), next(x5);
    next(x6), next(x7), next(x8), next(x9), next(x10), next(x11);
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
