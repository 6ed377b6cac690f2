// Implements writer_thread.h.
#include "ringlet/run/writer_thread.h"

#include <system_error>
#include <utility>

#include "ringlet/base/assert.h"

namespace ringlet {

WriterThread::WriterThread(std::size_t room) : room_(room) {
  RINGLET_ASSERT(room >= 1, "a queue has room for a job");
  try {
    thread_ = std::thread([this] { run(); });
  } catch (const std::system_error&) {
    // No thread is available: the caller's thread does the work.
  }
}

WriterThread::~WriterThread() {
  {
    const std::lock_guard lock(mutex_);
    isOver_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

Status WriterThread::hand(Job job) {
  std::unique_lock lock(mutex_);
  if (!thread_.joinable()) {
    lock.unlock();
    if (outcome()) doJob(job);
    return outcome();
  }
  changed_.wait(lock, [this] { return jobs_.size() <= room_ || failure_ || thrown_; });
  if (Status status = outcome(); !status) return status;
  jobs_.push_back(std::move(job));
  changed_.notify_all();
  return {};
}

Status WriterThread::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return jobs_.empty(); });
  return outcome();
}

void WriterThread::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return isOver_ || !jobs_.empty(); });
    if (jobs_.empty()) return;
    if (!failure_ && !thrown_) {
      const Job& job = jobs_.front();  // a deque keeps it in place while others are added
      lock.unlock();
      doJob(job);
      lock.lock();
    }
    jobs_.pop_front();
    changed_.notify_all();
  }
}

void WriterThread::doJob(const Job& job) {
  std::optional<Error> failure;
  std::exception_ptr thrown;
  try {
    if (const Status done = job(); !done) failure = done.error();
  } catch (...) {
    thrown = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  if (failure) failure_ = std::move(failure);
  if (thrown) thrown_ = thrown;
}

Status WriterThread::outcome() const {
  if (thrown_) std::rethrow_exception(thrown_);
  if (failure_) return *failure_;
  return {};
}

}  // namespace ringlet
