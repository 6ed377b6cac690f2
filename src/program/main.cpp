// The `ringlet` command. Each subcommand has a file; this one only joins them and turns a wrong command line
// into advice.
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
#include "program/convert/convert_command.h"
#include "program/convert/make_command.h"
#include "program/convert/material_command.h"
#include "program/device/conform_command.h"
#include "program/device/devices_command.h"
#include "program/device/kernels_command.h"
#include "program/device/tune_command.h"
#include "program/measure/info_command.h"
#include "program/measure/measure_command.h"
#include "program/render/render_command.h"
#include "program/simulate/scene_command.h"
#include "program/simulate/simulate_command.h"
#include "program/sweep/sweep_command.h"
#include "program/view/view_command.h"
#include "ringlet/version.h"

namespace ringlet::program {
namespace {

int run(int argumentCount, char** arguments) {
  int exitCode = kExitFine;
  failInsteadOfEnding();
  if (const std::string wrong = mpi::joinRanks(argumentCount, arguments); !wrong.empty()) {
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
  ringlet::mpi::leaveRanks(exitCode);
  return exitCode;
}
