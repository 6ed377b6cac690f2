// WriterThread: runs jobs in order on a thread of its own, so that the next frame is computed while files of
// the last are written.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "ringlet/base/result.h"

namespace ringlet {

/// Jobs are handed over by one thread. If the system can start no thread, jobs run as they are handed over.
class WriterThread {
 public:
  using Job = std::function<Status()>;

  /// At most `room` jobs, 1 or more, wait beside the running one, which limits the memory they hold.
  explicit WriterThread(std::size_t room);
  /// Runs the remaining jobs.
  ~WriterThread();
  WriterThread(const WriterThread&) = delete;
  WriterThread& operator=(const WriterThread&) = delete;

  /// Adds a job; waits while there is no room. Returns the error of an earlier job, and rethrows what an
  /// earlier job threw; after either no further job runs.
  Status hand(Job job);
  /// Waits until all jobs are done; returns and throws errors as hand does. Afterwards the jobs' results may
  /// be read.
  Status finish();

 private:
  void run();
  void doJob(const Job& job);  // stores how it failed
  Status outcome() const;      // needs the lock, or that no thread runs

  const std::size_t room_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> jobs_;  // the first one is running
  bool isOver_ = false;
  std::optional<Error> failure_;
  std::exception_ptr thrown_;
  std::thread thread_;
};

}  // namespace ringlet
