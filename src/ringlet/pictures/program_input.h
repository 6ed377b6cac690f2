// ProgramInput: starts another program, such as gnuplot or ffmpeg, and writes to its standard input.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"

namespace ringlet {

struct OtherProgram {
  const char* name;     // to be searched on the path
  const char* does;     // what it is for, such as "plots are drawn"
  const char* package;  // of Debian
};

/// Fails if it is not found; the error says what to install.
Status checkInstalled(const OtherProgram& program);

class ProgramInput {
 public:
  /// The program's messages go to standard error. Errors: it is not installed, or cannot be started.
  static Result<ProgramInput> start(const OtherProgram& program, const std::vector<std::string>& arguments);
  ProgramInput(ProgramInput&& other) noexcept;
  ProgramInput& operator=(ProgramInput&&) = delete;
  ~ProgramInput() { end(); }

  /// Errors: the program ended before it had read everything.
  Status write(std::span<const std::byte> bytes);
  /// Stops the program if it has not finished.
  void end();
  /// Waits until it has finished. Errors: it reports a failure.
  Status finish();

 private:
  ProgramInput(const OtherProgram& program, pid_t process, int pipe)
      : program_(program), process_(process), pipe_(pipe) {}
  Error failed() const;

  OtherProgram program_;
  pid_t process_ = -1;
  int pipe_ = -1;
};

}  // namespace ringlet
