// Implements scenes/load/scene_paths.h.
#include "ringlet/scenes/load/scene_paths.h"

#include <filesystem>
#include <system_error>

namespace ringlet {

void makePathsAbsolute(SceneFile& scene) {
  forEachFileOf(scene, [](std::filesystem::path& path) {
    std::error_code code;
    const std::filesystem::path whole = std::filesystem::absolute(path, code);
    if (!code) path = whole.lexically_normal();
  });
}

}  // namespace ringlet
