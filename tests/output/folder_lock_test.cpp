// A folder has one owner; one that died is said to have died.
#include "ringlet/output/folder_lock.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>

#include "tests/support/test_support.h"

namespace ringlet::test {
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

TEST(FolderLock, NeedsAFolder) {
  const auto folder = scratchFolder("lock_none");
  const auto lock = FolderLock::take(folder / "none", "x");
  ASSERT_FALSE(lock);
  EXPECT_EQ(lock.error().fault, Fault::output);
}

}  // namespace
}  // namespace ringlet::test
