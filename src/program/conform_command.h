// `ringlet conform`: holds a device and its driver against the reference, and says what is wrong.
#pragma once

#include "program/cli_fwd.h"

namespace ringlet::program {

void addConformCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
