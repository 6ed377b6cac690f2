// `ringlet kernels`: compiles every kernel and shows the driver's statistics.
#pragma once

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

void addKernelsCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
