// `ringlet scene`: the built-in scenes, run and measured.
#pragma once

#include "program/cli_fwd.h"

namespace ringlet::program {

/// Adds the subcommand; `exitCode` receives what the program is to return once it has run.
void addSceneCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
