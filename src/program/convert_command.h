// `ringlet convert`: an animation as another file, and what is in one.
#pragma once

#include "program/cli_fwd.h"

namespace ringlet::program {

/// Adds the subcommand; `exitCode` receives what the program is to return once it has run.
void addConvertCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
