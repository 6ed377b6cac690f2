// `ringlet simulate`: hair from a file, moved by a head, written as an animation.
#pragma once

#include "program/cli_fwd.h"

namespace ringlet::program {

/// Adds the subcommand; `exitCode` receives what the program is to return once it has run.
void addSimulateCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
