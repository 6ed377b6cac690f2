// A folder has one owner; one that died is said to have died.
#include "ringlet/output/folder_lock.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <string>
#include <thread>

#include "tests/support/test_support.h"

namespace ringlet::test::folder_lock_test {
namespace {

TEST(FolderLock, IsForOneAtATime) {
  const auto folder = scratchFolder("lock");
  {
    const auto first = FolderLock::take(folder, "first");
    ASSERT_TRUE(first) << first.error().message;
    EXPECT_EQ(first->deadOwner(), "");
    const auto second = FolderLock::take(folder, "second");
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().fault, Fault::busy);
    EXPECT_NE(second.error().message.find("process " + std::to_string(getpid())), std::string::npos);
    EXPECT_NE(second.error().message.find("(first)"), std::string::npos);
    EXPECT_FALSE(FolderLock::take(folder, "third")) << "a refusal gave the lock away";
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  const auto next = FolderLock::take(folder, "next");
  ASSERT_TRUE(next);
  EXPECT_EQ(next->deadOwner(), "");
}

TEST(FolderLock, ADeadOwnersIsTakenOver) {
  const auto folder = scratchFolder("lock_dead");
  const pid_t child = fork();
  if (child == 0) {
    const auto lock = FolderLock::take(folder, "the one that dies");
    raise(SIGKILL);
  }
  waitpid(child, nullptr, 0);
  const auto lock = FolderLock::take(folder, "heir");
  ASSERT_TRUE(lock) << lock.error().message;
  EXPECT_NE(lock->deadOwner().find("process " + std::to_string(child)), std::string::npos)
      << lock->deadOwner();
  EXPECT_NE(lock->deadOwner().find("the one that dies"), std::string::npos);
}

TEST(FolderLock, WaitsForAnOwnerThatIsAboutToEnd) {
  const auto folder = scratchFolder("lock_ending");
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  const pid_t child = fork();
  if (child == 0) {
    const auto lock = FolderLock::take(folder, "the one that ends");
    if (write(ends[1], "x", 1) == 1) pause();
    _exit(1);
  }
  char taken = 0;
  ASSERT_EQ(read(ends[0], &taken, 1), 1);
  EXPECT_FALSE(FolderLock::take(folder, "impatient"));
  std::thread end([child] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
  });
  const auto lock = FolderLock::take(folder, "heir", std::chrono::minutes(1));
  end.join();
  ASSERT_TRUE(lock) << lock.error().message;
  EXPECT_NE(lock->deadOwner().find("the one that ends"), std::string::npos);
}

TEST(FolderLock, NeedsAFolder) {
  const auto folder = scratchFolder("lock_none");
  const auto lock = FolderLock::take(folder / "none", "x");
  ASSERT_FALSE(lock);
  EXPECT_EQ(lock.error().fault, Fault::output);
}

}  // namespace
}  // namespace ringlet::test::folder_lock_test
