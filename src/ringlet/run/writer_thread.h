// WriterThread: does jobs in order on a thread of its own, so that the next frame computes while files of the
// last are written.
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

/// Handed to by one thread. Where the system has no thread to give, jobs are done as they are handed over.
class WriterThread {
 public:
  using Job = std::function<Status()>;

  /// At most `room` jobs, from 1 up, wait beside the one being done: that bounds the memory they hold.
  explicit WriterThread(std::size_t room);
  /// Does what was handed over.
  ~WriterThread();
  WriterThread(const WriterThread&) = delete;
  WriterThread& operator=(const WriterThread&) = delete;

  /// Hands a job over; waits while there is no room. The failure of an earlier job comes back here, and what
  /// an earlier job threw is thrown; after either no job is done any more.
  Status hand(Job job);
  /// Waits until all jobs are done, and tells of failures as hand does. What jobs wrote may be read after it.
  Status finish();

 private:
  void run();
  void doJob(const Job& job);  // notes how it failed
  Status outcome() const;      // needs the lock, or no thread

  const std::size_t room_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> jobs_;  // the first is being done
  bool isOver_ = false;
  std::optional<Error> failure_;
  std::exception_ptr thrown_;
  std::thread thread_;
};

}  // namespace ringlet
