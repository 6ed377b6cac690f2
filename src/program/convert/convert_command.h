// `ringlet convert`: writes an animation in another format, or describes a file.
#pragma once

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

/// Adds the subcommand; when it runs, `exitCode` receives the exit status of the program.
void addConvertCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
