// ProgressBar: the progress of a run and the time left. On a terminal one line that changes; otherwise, as in
// a log, a line every half minute.
#pragma once

#include <chrono>
#include <string>

namespace ringlet::program {

class ProgressBar {
 public:
  /// `first`: frames done before the run begins.
  ProgressBar(int first, int count, bool wanted, const char* what = "frame");
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;

  void show(int finished);
  /// Removes the bar, so that other output starts on an empty line.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  /// "2:05 left"; "" while it cannot be estimated.
  std::string leftAfter(int finished) const;

  int first_, count_;
  const char* what_;
  bool isWanted_, isTerminal_;
  bool visible_ = false;
  Clock::time_point start_ = Clock::now(), lastShown_ = start_;
};

}  // namespace ringlet::program
