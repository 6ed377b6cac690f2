// ProgressBar: how far a run is and how long it will take. On a terminal one line that changes; elsewhere, as
// in a log, a line every half minute.
#pragma once

#include <chrono>
#include <string>

namespace ringlet::program {

class ProgressBar {
 public:
  /// `first`: what is done before it begins.
  ProgressBar(int first, int count, bool wanted, const char* what = "frame");
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;

  void show(int finished);
  /// Leaves an empty line for what comes next.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  /// "2:05 left"; "" as long as it cannot be told.
  std::string leftAfter(int finished) const;

  int first_, count_;
  const char* what_;
  bool isWanted_, isTerminal_;
  bool visible_ = false;
  Clock::time_point start_ = Clock::now(), lastShown_ = start_;
};

}  // namespace ringlet::program
