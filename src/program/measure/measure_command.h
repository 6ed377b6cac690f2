// `ringlet measure`: what became of the curl, in numbers.
#pragma once

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

/// Adds the subcommand; when it runs, `exitCode` receives the exit status of the program.
void addMeasureCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
