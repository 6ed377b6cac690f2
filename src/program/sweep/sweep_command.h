// `ringlet sweep`: runs a scene with every combination of some varied keys.
#pragma once

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

/// Adds the subcommand; when it runs, `exitCode` receives the exit status of the program.
void addSweepCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
