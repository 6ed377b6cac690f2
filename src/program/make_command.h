// `ringlet make curl|swatch|head`: grooms to try things on, without a file to start from.
#pragma once

#include "program/cli_fwd.h"

namespace ringlet::program {

/// Adds the subcommand; `exitCode` receives what the program is to return once it has run.
void addMakeCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
