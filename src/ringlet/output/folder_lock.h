// FolderLock: a run owns the folder it writes into. A file there, `.ringlet.lock`, says whose it is and is
// held with an advisory lock (flock), which the system releases when the process ends, however it ends.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "ringlet/base/result.h"

namespace ringlet {

class FolderLock {
 public:
  /// Errors: another process has it (Fault::busy, with its number, host and command), or the folder cannot be
  /// written. `command`: what to tell others. patience: how long to wait for another process that may be
  /// about to end, as one that was just killed is. Where the file system has no locks, the owner's process is
  /// looked for on this host.
  static Result<FolderLock> take(const std::filesystem::path& folder, const std::string& command,
                                 std::chrono::milliseconds patience = {});

  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;
  /// Gives it back, and removes the file.
  ~FolderLock();

  /// The process that had it and ended without giving it back, as "process 12 on host a (ringlet simulate
  /// ...)"; or "".
  const std::string& deadOwner() const { return deadOwner_; }

 private:
  FolderLock(std::filesystem::path path, int file) : path_(std::move(path)), file_(file) {}

  std::filesystem::path path_;
  int file_ = -1;  // descriptor
  std::string deadOwner_;
};

}  // namespace ringlet
