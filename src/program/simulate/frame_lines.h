// FrameLines: prints a line of JSON on standard output for each frame that is written, for a scheduler
// (--json-progress).
#pragma once

#include <chrono>

namespace ringlet::program {

class FrameLines {
 public:
  /// `first`: frames done before this run; `count`: frames in all; `run`: number within a sweep; 0: no sweep.
  FrameLines(int first, int count, int run) : first_(first), count_(count), run_(run) {}

  /// Prints {"frame": 12, "frames": 48, "seconds": 3.1, "seconds_left": 9.3}; in a sweep with "run": 3 in
  /// front.
  void tell(int frame) const;

 private:
  int first_, count_, run_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace ringlet::program
