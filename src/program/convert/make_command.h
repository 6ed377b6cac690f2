// `ringlet make curl|swatch|head`: grooms to try things on, without a file to start from.
#pragma once

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

/// Adds the subcommand; when it runs, `exitCode` receives the exit status of the program.
void addMakeCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
