// The `ringlet` command: gives advice on a wrong command line, and an exit status for a failure.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "mpi/ranks.h"
#include "program/cli/command_line.h"
#include "program/cli/exit_codes.h"
#include "program/cli/interruption.h"
#include "program/cli/standard_error.h"
#include "program/commands.h"

namespace ringlet::program {
namespace {

int run(int argumentCount, char** arguments) {
  int exitCode = kExitFine;
  failInsteadOfEnding();
  if (const std::string wrong = mpi::joinRanks(argumentCount, arguments); !wrong.empty()) {
    say("ringlet: {}\n", wrong);
    return kExitUsage;
  }

  CLI::App app;
  addCommands(app, exitCode);

  try {
    app.parse(argumentCount, arguments);
  } catch (const CLI::Success& asked) {
    exitCode = app.exit(asked);  // --help, --version
    std::cout.flush();
  } catch (const CLI::ParseError& error) {
    say("{}\n", usageMessage(app, error));
    return kExitUsage;
  } catch (const std::bad_alloc&) {
    say("ringlet: not enough memory for this groom\n");
    return kExitHostMemory;
  } catch (const std::exception& error) {
    if (std::ferror(stdout) == 0) {
      say("ringlet: {}\n", error.what());
      return kExitFailed;
    }  // the error is about printing itself
  }
  // A full disk or a closed pipe behind standard output is a failure too, since the text is lost.
  const bool isWritten = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
  if (!isWritten && exitCode == kExitFine) {
    say("ringlet: cannot write to standard output\n");
    return kExitOutput;
  }
  return exitCode;
}

}  // namespace
}  // namespace ringlet::program

int main(int argumentCount, char** arguments) {
  const int exitCode = ringlet::program::run(argumentCount, arguments);
  ringlet::mpi::leaveRanks(exitCode);
  return exitCode;
}
