// Implements output/folder_lock.h.
#include "ringlet/output/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <system_error>
#include <thread>
#include <utility>

#include "ringlet/base/file_fault.h"

namespace ringlet {
namespace {

struct Owner {
  long process = 0;
  std::string host, command;

  std::string text() const { return fmt::format("{}\n{}\n{}\n", process, host, command); }
  std::string described() const { return fmt::format("process {} on {} ({})", process, host, command); }
};

std::string thisHost() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

// What the file says; nothing where it is empty, or another's.
Owner ownerIn(int file) {
  std::array<char, 4096> bytes{};
  const ssize_t count = pread(file, bytes.data(), bytes.size(), 0);
  const std::string text(bytes.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  const std::size_t first = text.find('\n'), second = text.find('\n', first + 1);
  if (first == std::string::npos || second == std::string::npos) return {};
  Owner owner;
  owner.process = std::strtol(text.c_str(), nullptr, 10);
  owner.host = text.substr(first + 1, second - first - 1);
  owner.command = text.substr(second + 1, text.find('\n', second + 1) - second - 1);
  return owner;
}

bool isAlive(const Owner& owner) {
  if (owner.process <= 0) return false;
  if (owner.host != thisHost()) return true;  // for all that is known
  return kill(static_cast<pid_t>(owner.process), 0) == 0 || errno == EPERM;
}

// Whether the file of that name is still this one: its owner may have removed it between our opening and our
// lock.
bool isThatFile(const std::filesystem::path& path, int file) {
  struct stat named {
  }, open{};
  return stat(path.c_str(), &named) == 0 && fstat(file, &open) == 0 && named.st_ino == open.st_ino &&
         named.st_dev == open.st_dev;
}

Error cannotLock(const std::filesystem::path& folder, int code) {
  return {fmt::format("cannot write into {}: {}; choose a folder you may write to", folder.string(),
                      std::generic_category().message(code)),
          writeFault(code)};
}

}  // namespace

Result<FolderLock> FolderLock::take(const std::filesystem::path& folder, const std::string& command,
                                    std::chrono::milliseconds patience) {
  using Clock = std::chrono::steady_clock;
  const std::filesystem::path path = folder / ".ringlet.lock";
  const Clock::time_point end = Clock::now() + patience;
  while (true) {
    const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
    if (file < 0) return cannotLock(folder, errno);
    FolderLock lock(path, file);
    const bool isLocked = flock(file, LOCK_EX | LOCK_NB) == 0;
    const bool isTaken = !isLocked && errno == EWOULDBLOCK;
    const Owner before = ownerIn(file);
    if (isTaken || (!isLocked && isAlive(before))) {
      lock.path_.clear();  // it is not ours to remove
      if (Clock::now() < end) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        continue;
      }
      return Error{fmt::format("{} is being written by {}; wait for its end, or choose another folder",
                               folder.string(), before.process > 0 ? before.described() : "another process"),
                   Fault::busy};
    }
    if (!isThatFile(path, file)) {
      lock.path_.clear();
      continue;
    }
    if (before.process > 0) lock.deadOwner_ = before.described();
    const std::string text = Owner{getpid(), thisHost(), command}.text();
    if (ftruncate(file, 0) != 0 ||
        pwrite(file, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()))
      return cannotLock(folder, errno);
    return lock;
  }
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : path_(std::exchange(other.path_, {})),
      file_(std::exchange(other.file_, -1)),
      deadOwner_(std::move(other.deadOwner_)) {}

FolderLock::~FolderLock() {
  if (file_ < 0) return;
  if (!path_.empty()) unlink(path_.c_str());  // while it is locked, so that nobody else's is removed
  close(file_);
}

}  // namespace ringlet
