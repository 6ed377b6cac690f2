// FrameLines: one line of JSON on standard output for each frame that is written, for a scheduler
// (--json-progress).
#pragma once

#include <chrono>

namespace ringlet::program {

class FrameLines {
 public:
  /// `first`: frames done before; of `count`. `run`: of a sweep, its number; 0: of none.
  FrameLines(int first, int count, int run) : first_(first), count_(count), run_(run) {}

  /// {"frame": 12, "frames": 48, "seconds": 3.1, "seconds_left": 9.3}; "run": 3 first, of a sweep.
  void tell(int frame) const;

 private:
  int first_, count_, run_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace ringlet::program
