// What the processor can do at most, to hold rates against: fused multiply-adds on all cores, and copying.
#pragma once

#include <vector>

#include "bench/thread_team.h"

namespace ringlet::bench {

/// AVX2 fused multiply-adds that wait for nothing, on every thread of the team at once, for about `seconds`;
/// two operations each, by the threads' own CPU time [1/s]. 0 where the CPU has none.
double multiplyAddPeak(ThreadTeam& team, double seconds);

/// Copies a buffer beyond caches, the team together; what is read and what is written both count.
class CopyPeak {
 public:
  explicit CopyPeak(std::size_t bytes = std::size_t{256} << 20);
  double measure(ThreadTeam& team);  // [bytes/s]

 private:
  std::vector<char> from_, to_;
};

}  // namespace ringlet::bench
