// The `ringlet` command. Each subcommand has a file; this one only joins them and turns a wrong command line
// into advice.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "program/command_line.h"
#include "program/conform_command.h"
#include "program/convert_command.h"
#include "program/devices_command.h"
#include "program/exit_codes.h"
#include "program/info_command.h"
#include "program/interruption.h"
#include "program/kernels_command.h"
#include "program/make_command.h"
#include "program/material_command.h"
#include "program/measure_command.h"
#include "program/ranks.h"
#include "program/render_command.h"
#include "program/scene_command.h"
#include "program/simulate_command.h"
#include "program/standard_error.h"
#include "program/sweep_command.h"
#include "program/tune_command.h"
#include "program/view_command.h"
#include "ringlet/version.h"

namespace ringlet::program {
namespace {

int run(int argumentCount, char** arguments) {
  int exitCode = kExitFine;
  failInsteadOfEnding();
  if (const std::string wrong = joinRanks(argumentCount, arguments); !wrong.empty()) {
    say("ringlet: {}\n", wrong);
    return kExitUsage;
  }

  CLI::App app("Ringlet simulates stylised curly hair on the GPU.", "ringlet");
  app.set_version_flag("--version", "ringlet " RINGLET_VERSION);
  app.require_subcommand(1);
  app.get_formatter()->column_width(28);
  app.footer(
      "Example:\n  ringlet make head -o head.obj\n  ringlet simulate head.obj -o out\n\nEach command has its "
      "own --help.");
  addMakeCommand(app, exitCode);
  addSimulateCommand(app, exitCode);
  addSweepCommand(app, exitCode);
  addInfoCommand(app, exitCode);
  addMeasureCommand(app, exitCode);
  addRenderCommand(app, exitCode);
  addViewCommand(app, exitCode);
  addConvertCommand(app, exitCode);
  addSceneCommand(app, exitCode);
  addDevicesCommand(app, exitCode);
  addTuneCommand(app, exitCode);
  addConformCommand(app, exitCode);
  addKernelsCommand(app, exitCode);
  addMaterialCommand(app, exitCode);

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
    }  // else it is of what could not be printed
  }
  // A full disk or a closed pipe behind standard output is a failure too: someone waits for that text.
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
  ringlet::program::leaveRanks(exitCode);
  return exitCode;
}
