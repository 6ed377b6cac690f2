// Runs the built `ringlet` command as a user would, for tests.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "ringlet/output/checkpoint_file.h"
#include "tests/support/test_support.h"

namespace ringlet::test {

struct ProgramResult {
  int exitCode = -1;  // -1: it was killed by a signal
  std::string out, err;
};

/// Standard error without what is said where the driver compiles for longer than a second.
inline std::string withoutCompileNotes(const std::string& err) {
  std::string rest;
  for (std::size_t begin = 0; begin < err.size();) {
    const std::size_t end = std::min(err.find('\n', begin), err.size() - 1) + 1;
    const std::string line = err.substr(begin, end - begin);
    if (!line.starts_with("ringlet: compil")) rest += line;
    begin = end;
  }
  return rest;
}

/// A program started in a folder, its outputs caught in files there.
class RunningProgram {
 public:
  RunningProgram(std::filesystem::path folder, const std::vector<std::string>& arguments)
      : folder_(std::move(folder)) {
    std::vector<std::string> all{RINGLET_BUILD_DIR "/ringlet"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& argument : all) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    const std::string out = (folder_ / "stdout.txt").string(), err = (folder_ / "stderr.txt").string();
    for (const std::string& before : {out, err})
      std::filesystem::remove(before);  // no test waits for another's words
    process_ = fork();
    if (process_ != 0) return;
    if (chdir(folder_.c_str()) != 0) _exit(120);
    setenv("RINGLET_CACHE_DIR", RINGLET_BUILD_DIR "/tests/cache", 0);  // not the user's, who may have tuned
    dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), STDOUT_FILENO);
    dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), STDERR_FILENO);
    execv(pointers[0], pointers.data());
    _exit(121);
  }

  void send(int signal) { kill(process_, signal); }

  /// Waits until the condition holds, however busy the machine is; false where the program ended before.
  bool waitUntil(const std::function<bool()>& condition) const {
    while (!condition()) {
      if (isOver()) return condition();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return true;
  }

  /// Whether it has a handler of its own for a signal (Linux: the mask of /proc).
  bool handles(int signal) const {
    std::istringstream lines(readText("/proc/" + std::to_string(process_) + "/status"));
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("SigCgt:"))
        return (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1) != 0;
    }
    return false;
  }

  ProgramResult wait() {
    int status = 0;
    waitpid(process_, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readText(folder_ / "stdout.txt"),
            readText(folder_ / "stderr.txt")};
  }

 private:
  bool isOver() const {
    siginfo_t ended{};
    return waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 ||
           ended.si_pid == process_;
  }

  std::filesystem::path folder_;
  pid_t process_ = -1;
};

inline ProgramResult runProgram(const std::filesystem::path& folder,
                                const std::vector<std::string>& arguments) {
  return RunningProgram(folder, arguments).wait();
}

/// Whether a run in this folder has a checkpoint to go on from. That from before its first frame is none; a
/// thread writes them, on a slow disk later.
inline bool hasDoneFrames(const std::filesystem::path& folder) {
  const auto checkpoint = readCheckpoint(folder / "checkpoint.rgk");
  return checkpoint && checkpoint->frame > 0;
}

}  // namespace ringlet::test

// Skips loudly where no Vulkan device can run the solver; under RINGLET_REQUIRE_GPU=1 that is a failure.
#define RINGLET_NEEDS_DEVICE(folder)                                                                    \
  if (::ringlet::test::runProgram(folder, {"devices"}).exitCode != 0) {                                 \
    const char* required = std::getenv("RINGLET_REQUIRE_GPU");                                          \
    if (required && std::string(required) == "1") FAIL() << "no Vulkan device, though one is required"; \
    GTEST_SKIP() << "SKIPPED: no Vulkan device";                                                        \
  }
