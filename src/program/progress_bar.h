// ProgressBar: one line on the terminal that shows how far a run is and how long it will take; silent where
// standard error is no terminal.
#pragma once

#include <chrono>

namespace ringlet::program {

class ProgressBar {
 public:
  ProgressBar(int count, bool wanted, const char* what = "frame");
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;

  void show(int finished);
  /// Leaves an empty line for what comes next.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  int count_;
  const char* what_;
  bool enabled_;
  bool visible_ = false;
  Clock::time_point start_ = Clock::now(), lastShown_{};
};

}  // namespace ringlet::program
