// `ringlet kernels`: what the driver's compiler makes of every kernel.
#pragma once

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

void addKernelsCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
