// Scenes as Python holds them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "python/binding.h"
#include "python/grooms.h"
#include "ringlet/output/checkpoint_file.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet::python {

/// What a scene was made of.
struct SceneSource {
  std::optional<SceneFile> file;  // none: built in
  std::filesystem::path path;     // of that file; empty: a text
  std::vector<RunFact> facts;     // of a built-in one
};

struct SceneObject {
  std::string name, summary;
  GroomHandle groom;
  LoadedScene loaded;  // but its groom, which is the one above
  SceneSource source;

  /// With its groom.
  LoadedScene whole() const {
    LoadedScene scene = loaded;
    scene.groom = groom->groom();
    return scene;
  }
};

/// Scene.run, Frame and RunResult.
void addRuns(py::module_& module, py::class_<SceneObject>& scene);

}  // namespace ringlet::python
