// `ringlet view`: a window in which a scene's hair moves, and its numbers change.
#pragma once

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

void addViewCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
