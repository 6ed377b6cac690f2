// Work shared by threads: all of it is done, and what one of them throws comes to the caller.
#include "ringlet/base/in_parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <set>

namespace ringlet::in_parallel_test {
namespace {

TEST(InParallel, ThreadsShareTheWork) {
  std::atomic<int> next = 0, done = 0, there = 0;
  std::mutex mutex;
  std::set<std::thread::id> threads;
  inParallel(4, [&] {
    {
      const std::lock_guard lock(mutex);
      threads.insert(std::this_thread::get_id());
    }
    ++there;
    while (there < 4) std::this_thread::yield();
    for (int i = next++; i < 1000; i = next++) ++done;
  });
  EXPECT_EQ(done, 1000);
  EXPECT_EQ(threads.size(), 4u);
}

TEST(InParallel, PartsAreHandedOutOnce) {
  for (const std::size_t count : {0u, 1u, 64u, 1000u}) {
    std::vector<std::atomic<int>> done(count);
    eachInParallel(4, count, 64, [&](std::size_t i) { ++done[i]; });
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(done[i], 1) << i << " of " << count;
  }
}

TEST(InParallel, WhatAnyThrowsComesToTheCaller) {
  const auto caller = std::this_thread::get_id();
  for (const bool inCaller : {false, true}) {
    std::atomic<int> ended = 0;
    const auto work = [&] {
      ++ended;
      if ((std::this_thread::get_id() == caller) == inCaller) throw std::bad_alloc();
    };
    EXPECT_THROW(inParallel(3, work), std::bad_alloc);
    EXPECT_EQ(ended, 3) << "not waited for";
  }
}

}  // namespace
}  // namespace ringlet::in_parallel_test
