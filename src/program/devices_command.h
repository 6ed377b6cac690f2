// `ringlet devices`: what simulations could run on.
#pragma once

#include "program/cli_fwd.h"

namespace ringlet::program {

/// Adds the subcommand; `exitCode` receives what the program is to return once it has run.
void addDevicesCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
