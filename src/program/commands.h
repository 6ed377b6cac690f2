// All commands of `ringlet`; each has a file of its own.
#pragma once

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

/// Adds the commands. A command that was parsed runs and sets the exit status.
void addCommands(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
