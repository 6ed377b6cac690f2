// `ringlet tune`: which strand shapes are fastest on a device, measured and remembered.
#pragma once

#include "program/cli_fwd.h"

namespace ringlet::program {

/// Adds the subcommand; `exitCode` receives what the program is to return once it has run.
void addTuneCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
