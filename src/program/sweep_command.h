// `ringlet sweep`: a scene with some of its keys varied, every combination a run.
#pragma once

#include "program/cli_fwd.h"

namespace ringlet::program {

/// Adds the subcommand; `exitCode` receives what the program is to return once it has run.
void addSweepCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
