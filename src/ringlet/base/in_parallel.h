// The same work on several threads, which share it among them by a counter of their own.
#pragma once

#include <algorithm>
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

}  // namespace ringlet
