// Implements progress_bar.h.
#include "program/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace ringlet::program {
namespace {

constexpr int kWidth = 30;  // characters of the bar itself; the line fits a terminal of 80
constexpr std::chrono::milliseconds kPause{80};  // between two updates: often enough to look alive

std::string clockTime(double seconds) {
  const auto whole = static_cast<long>(std::ceil(seconds));
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

ProgressBar::ProgressBar(int count, bool wanted, const char* what)
    : count_(count), what_(what), enabled_(wanted && isatty(STDERR_FILENO) == 1) {}

void ProgressBar::show(int finished) {
  const auto now = Clock::now();
  if (!enabled_ || (visible_ && now - lastShown_ < kPause && finished < count_)) return;
  lastShown_ = now;
  visible_ = true;
  const double share = static_cast<double>(finished) / count_;
  const int filled = static_cast<int>(share * kWidth);
  std::string line =
      fmt::format("\r  {} {}/{} [{:#<{}}{:.<{}}]", what_, finished, count_, "", filled, "", kWidth - filled);
  if (finished > 0) {
    const double seconds = std::chrono::duration<double>(now - start_).count();
    line += fmt::format(" {} left", clockTime(seconds / share - seconds));
  }
  fmt::print(stderr, "{}\x1b[K", line);
  std::fflush(stderr);
}

void ProgressBar::clear() {
  if (!visible_) return;
  fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
  visible_ = false;
}

}  // namespace ringlet::program
