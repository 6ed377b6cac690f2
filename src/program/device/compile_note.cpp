// Implements compile_note.h.
#include "program/device/compile_note.h"
#include "program/cli/standard_error.h"

#include <fmt/format.h>

#include <system_error>

namespace ringlet::program {

void CompileNote::begin(std::size_t kernelCount) {
  start_ = std::chrono::steady_clock::now();
  isDone_ = hasSpoken_ = false;
  const auto watch = [this, kernelCount] {
    std::unique_lock lock(mutex_);
    if (changed_.wait_for(lock, std::chrono::seconds(1), [this] { return isDone_; })) return;
    say("ringlet: compiling {} kernel{} for {}, but for what its driver has kept ...\n", kernelCount,
        kernelCount == 1 ? "" : "s", device_);
    hasSpoken_ = true;
  };
  try {
    watcher_ = std::thread(watch);
  } catch (const std::system_error&) {
    // No thread is available: nothing is printed.
  }
}

void CompileNote::end() {
  if (!watcher_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    isDone_ = true;
  }
  changed_.notify_one();
  watcher_.join();
  if (!hasSpoken_) return;
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start_;
  say("ringlet: compiled in {:.1f} s\n", seconds.count());
}

}  // namespace ringlet::program
