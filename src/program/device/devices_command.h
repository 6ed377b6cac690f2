// `ringlet devices`: lists the devices that simulations can run on.
#pragma once

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

/// Adds the subcommand; when it runs, `exitCode` receives the exit status of the program.
void addDevicesCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
