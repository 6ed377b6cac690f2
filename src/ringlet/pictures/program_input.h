// ProgramInput: another program, started to read from its standard input what this one writes: gnuplot,
// ffmpeg.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"

namespace ringlet {

struct OtherProgram {
  const char* name;     // as it is found on the path
  const char* does;     // "plots are drawn"
  const char* package;  // Debian's
};

/// Whether it can be found. The error says what to install.
Status checkInstalled(const OtherProgram& program);

class ProgramInput {
 public:
  /// What the program says stands on standard error. Errors: it is not installed, or cannot be started.
  static Result<ProgramInput> start(const OtherProgram& program, const std::vector<std::string>& arguments);
  ProgramInput(ProgramInput&& other) noexcept;
  ProgramInput& operator=(ProgramInput&&) = delete;
  ~ProgramInput() { end(); }

  /// Errors: the program has ended before it read all.
  Status write(std::span<const std::byte> bytes);
  /// Where it was not finished: stops it, whatever it has done so far.
  void end();
  /// Waits until it has done its work. Errors: it says that it could not.
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
