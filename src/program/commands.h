// All commands of `ringlet`, each of which has a file.
#pragma once

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

/// Each command, parsed, runs and sets the exit status.
void addCommands(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
