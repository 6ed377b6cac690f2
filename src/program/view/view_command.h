// `ringlet view`: a window that shows a scene's hair in motion and lets its numbers be changed.
#pragma once

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

void addViewCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
