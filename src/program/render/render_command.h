// `ringlet render`: pictures of a run, an animation, a scene or a groom.
#pragma once

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

void addRenderCommand(CLI::App& app, int& exitCode);

}  // namespace ringlet::program
