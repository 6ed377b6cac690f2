// MemoryLimit: what a reader may allocate, for tests that hand it files with false counts.
#pragma once

#include <sys/resource.h>

#include <cstddef>

namespace ringlet::test {

/// While it lives, this process has at most so many bytes of data: beyond, an allocation throws
/// std::bad_alloc, which fails the test at once instead of filling the machine. No limit under the address
/// sanitizer, which reserves far more than it uses.
class MemoryLimit {
 public:
  explicit MemoryLimit(std::size_t bytes) {
    getrlimit(RLIMIT_DATA, &before_);
#ifndef __SANITIZE_ADDRESS__
    struct rlimit small = before_;
    small.rlim_cur = bytes;
    setrlimit(RLIMIT_DATA, &small);
#else
    (void)bytes;
#endif
  }
  ~MemoryLimit() { setrlimit(RLIMIT_DATA, &before_); }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  struct rlimit before_ {};
};

}  // namespace ringlet::test
