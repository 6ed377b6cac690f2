// `ringlet devices`: what simulations could run on.
#pragma once

#include <CLI/CLI.hpp>

namespace ringlet::program {

/// Adds the subcommand; `exitCode` receives what the program is to return once it has run.
void addDevicesCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
