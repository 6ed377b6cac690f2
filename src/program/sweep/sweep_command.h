// `ringlet sweep`: a scene with some of its keys varied, every combination a run.
#pragma once

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

/// Adds the subcommand; when it runs, `exitCode` receives the exit status of the program.
void addSweepCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
