// Prints a line on standard error if the driver compiles kernels for longer than a moment, so that the first
// use of a device is not taken for a hang.
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

  /// Prints a line after a second.
  void begin(std::size_t kernelCount) override;
  /// Prints the time it took, if begin has printed a line.
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
