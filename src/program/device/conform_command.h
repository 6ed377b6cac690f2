// `ringlet conform`: compares a device and its driver with the reference and reports faults.
#pragma once

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

void addConformCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
