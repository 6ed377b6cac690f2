// A team of threads that does the same job together, again and again: the caller is one of them.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace ringlet::bench {

class ThreadTeam {
 public:
  explicit ThreadTeam(unsigned threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  unsigned size() const { return static_cast<unsigned>(others_.size()) + 1; }
  /// job(thread) on every thread, 0 the caller's; returns when all are done.
  void run(const std::function<void(unsigned)>& job);

 private:
  void serve(unsigned thread);

  std::mutex mutex_;
  std::condition_variable start_, done_;
  const std::function<void(unsigned)>* job_ = nullptr;
  std::uint64_t round_ = 0;
  unsigned busy_ = 0;
  bool ends_ = false;
  std::vector<std::thread> others_;
};

}  // namespace ringlet::bench
