// `ringlet scene`: the built-in scenes, run and measured.
#pragma once

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

/// Adds the subcommand; when it runs, `exitCode` receives the exit status of the program.
void addSceneCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
