// `ringlet conform`: holds a device and its driver against the reference, and says what is wrong.
#pragma once

#include <CLI/CLI.hpp>

namespace ringlet::program {

void addConformCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
