// The same work on several threads, which share it among them by a counter of their own.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace ringlet {

/// Runs work() on `threadCount` threads, this one among them; on fewer where the system has no more. Returns
/// when all have ended. An exception of any of them (such as std::bad_alloc) is rethrown here.
template <class Work>
void inParallel(unsigned threadCount, const Work& work) {
  std::mutex mutex;
  std::exception_ptr thrown;
  const auto guarded = [&] {
    try {
      work();
    } catch (...) {
      const std::lock_guard lock(mutex);
      thrown = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    try {
      for (unsigned i = 1; i < threadCount; ++i) others.emplace_back(guarded);
    } catch (const std::system_error&) {
    } catch (const std::bad_alloc&) {
    }
    guarded();
  }
  if (thrown) std::rethrow_exception(thrown);
}

/// How many threads the machine runs at once.
inline unsigned coreCount() { return std::max(1u, std::thread::hardware_concurrency()); }

/// Hands out [0, count) in parts of `partSize` or fewer, each to whoever asks first: for work that is the
/// same whoever does it.
class SharedParts {
 public:
  SharedParts(std::size_t count, std::size_t partSize) : count_(count), partSize_(partSize) {}

  /// Calls work(begin, end) for one part after another, until all have been handed out.
  template <class Work>
  void take(const Work& work) {
    for (std::size_t begin; (begin = next_.fetch_add(partSize_)) < count_;)
      work(begin, std::min(count_, begin + partSize_));
  }

 private:
  std::size_t count_, partSize_;
  std::atomic<std::size_t> next_ = 0;
};

/// work(i) for every i below `count`, on `threadCount` threads.
template <class Work>
void eachInParallel(unsigned threadCount, std::size_t count, std::size_t partSize, const Work& work) {
  SharedParts parts(count, partSize);
  inParallel(threadCount, [&] {
    parts.take([&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) work(i);
    });
  });
}

}  // namespace ringlet
