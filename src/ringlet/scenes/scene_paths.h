// The files and folders that a scene names.
#pragma once

#include <filesystem>
#include <vector>

#include "ringlet/scenes/scene_file.h"

namespace ringlet {

/// The value of every key that is a path, whether it is set or empty.
std::vector<std::filesystem::path*> pathsOf(SceneFile& scene);

}  // namespace ringlet
