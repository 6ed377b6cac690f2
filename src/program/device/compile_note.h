// A line on standard error while the driver compiles kernels for longer than a moment, so that nobody takes
// the first use of a device for a hang.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "ringlet/solver/simulation.h"

namespace ringlet::program {

class CompileNote : public CompileObserver {
 public:
  explicit CompileNote(std::string device) : device_(std::move(device)) {}
  ~CompileNote() override { end(); }

  /// After a second says what is going on.
  void begin(std::size_t kernelCount) override;
  /// Says how long it took, where begin has said something.
  void end() override;

 private:
  std::string device_;
  std::chrono::steady_clock::time_point start_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool isDone_ = false, hasSpoken_ = false;
  std::thread watcher_;
};

}  // namespace ringlet::program
