// Implements program_input.h.
#include "ringlet/pictures/program_input.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <utility>

extern char** environ;

namespace ringlet {

Status checkInstalled(const OtherProgram& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (access((std::filesystem::path(folder) / program.name).c_str(), X_OK) == 0) return {};
  }
  return Error{fmt::format("{} by {}, which is not installed (Debian: {})", program.does, program.name,
                           program.package)};
}

Result<ProgramInput> ProgramInput::start(const OtherProgram& program,
                                         const std::vector<std::string>& arguments) {
  if (Status installed = checkInstalled(program); !installed) return installed.error();
  const auto fail = [&](int code) {
    return Error{fmt::format("cannot start {}: {}", program.name, std::strerror(code))};
  };
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return fail(errno);
  std::vector<std::string> all{program.name};
  all.insert(all.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& argument : all) pointers.push_back(argument.data());
  pointers.push_back(nullptr);

  // A process group of its own: Ctrl-C must reach only this program, which then completes its output.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  pid_t process = -1;
  const int code = posix_spawnp(&process, program.name, &actions, &attributes, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  close(ends[0]);
  if (code != 0) {
    close(ends[1]);
    return fail(code);
  }
  std::signal(SIGPIPE, SIG_IGN);  // the other program may end before it has read everything
  return ProgramInput(program, process, ends[1]);
}

ProgramInput::ProgramInput(ProgramInput&& other) noexcept
    : program_(other.program_),
      process_(std::exchange(other.process_, -1)),
      pipe_(std::exchange(other.pipe_, -1)) {}

void ProgramInput::end() {
  if (pipe_ >= 0) close(std::exchange(pipe_, -1));
  if (process_ < 0) return;
  kill(process_, SIGTERM);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
}

Error ProgramInput::failed() const {
  return Error{fmt::format("{} could not do its work; it says why above", program_.name), Fault::output};
}

Status ProgramInput::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(pipe_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return failed();
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return {};
}

Status ProgramInput::finish() {
  close(std::exchange(pipe_, -1));
  int status = 0;
  while (waitpid(process_, &status, 0) < 0) {
    if (errno != EINTR) return failed();
  }
  process_ = -1;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  return failed();
}

}  // namespace ringlet
