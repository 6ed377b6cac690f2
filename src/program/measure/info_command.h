// `ringlet info`: what is in a groom's file, and what is wrong with it.
#pragma once

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

/// Adds the subcommand; when it is run, sets the exit code.
void addInfoCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
