// The option --confined of commands that read a scene file.
#pragma once

#include <filesystem>

#include "program/cli/cli_fwd.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet::program {

void addConfinedOption(CLI::App& command, SceneReach& reach);

/// Fails if the output folder of a confined scene contains a symbolic link, through which results could be
/// written elsewhere. A folder that does not exist is fine.
Status checkHoldsNoLinks(const std::filesystem::path& folder);

}  // namespace ringlet::program
