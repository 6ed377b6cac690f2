// --confined, of every command that reads a scene file.
#pragma once

#include <filesystem>

#include "program/cli/cli_fwd.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet::program {

void addConfinedOption(CLI::App& command, SceneReach& reach);

/// Fails where a folder that a confined scene names for its results holds a symbolic link, by which they
/// could be written elsewhere. Nothing to say of a folder that is not there.
Status checkHoldsNoLinks(const std::filesystem::path& folder);

}  // namespace ringlet::program
