// `ringlet tune`: measures which strand shapes are fastest on a device, and stores the result.
#pragma once

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

/// Adds the subcommand; when it runs, `exitCode` receives the exit status of the program.
void addTuneCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
