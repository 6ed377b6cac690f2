// `ringlet simulate`: hair from a file, moved by a head, written as an animation.
#pragma once

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

/// Adds the subcommand; when it runs, `exitCode` receives the exit status of the program.
void addSimulateCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
