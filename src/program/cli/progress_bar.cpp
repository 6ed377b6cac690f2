// Implements progress_bar.h.
#include "program/cli/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "program/cli/standard_error.h"

namespace ringlet::program {
namespace {

constexpr int kBarWidth = 30;                    // characters of the bar itself; the line fits 80 columns
constexpr std::chrono::milliseconds kPause{80};  // between updates: often enough to look alive
constexpr std::chrono::seconds kLinePause{30};   // between lines of a log

std::string clockTime(double seconds) {
  const auto whole = static_cast<long>(std::ceil(seconds));
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

ProgressBar::ProgressBar(int first, int count, bool wanted, const char* what)
    : first_(first), count_(count), what_(what), isWanted_(wanted), isTerminal_(isatty(STDERR_FILENO) == 1) {}

void ProgressBar::show(int finished) {
  if (!isWanted_) return;
  const auto now = Clock::now();
  const auto pause = isTerminal_ ? Clock::duration(kPause) : Clock::duration(kLinePause);
  const bool isFirst = isTerminal_ && !visible_, isLast = isTerminal_ && finished >= count_;
  if (now - lastShown_ < pause && !isFirst && !isLast) return;
  lastShown_ = now;
  const std::string left = leftAfter(finished);
  if (!isTerminal_) {
    say("ringlet: {} {} of {}{}{}\n", what_, finished, count_, left.empty() ? "" : ", ", left);
    return;
  }
  visible_ = true;
  const int filled = static_cast<int>(static_cast<double>(finished) / count_ * kBarWidth);
  sayAsItIs(fmt::format("\r  {} {}/{} [{:#<{}}{:.<{}}] {}\x1b[K", what_, finished, count_, "", filled, "",
                        kBarWidth - filled, left));
  std::fflush(stderr);
}

std::string ProgressBar::leftAfter(int finished) const {
  if (finished <= first_) return "";
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  return fmt::format("{} left", clockTime(seconds * (count_ - finished) / (finished - first_)));
}

void ProgressBar::clear() {
  if (!visible_) return;
  sayAsItIs("\r\x1b[K");
  std::fflush(stderr);
  visible_ = false;
}

}  // namespace ringlet::program
