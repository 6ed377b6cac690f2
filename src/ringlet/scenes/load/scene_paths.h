// Every file that a scene names to be read, in one place: for runs that compare, move or confine them.
#pragma once

#include "ringlet/scenes/file/scene_file.h"

namespace ringlet {

/// Calls visit(path) for each; empty paths are left out. A material's file is not among them: it is read with
/// the scene. `Scene` is SceneFile or const SceneFile.
template <class Scene, class Visit>
void forEachFileOf(Scene& scene, const Visit& visit) {
  const auto named = [&](auto&... paths) {
    const auto one = [&](auto& path) {
      if (!path.empty()) visit(path);
    };
    (one(paths), ...);
  };
  named(scene.groom.file, scene.groom.scalp, scene.groom.guidesFile, scene.start.from, scene.motion.file,
        scene.scalp.file, scene.scalp.cache, scene.goalFile, scene.output.hairScalpFile);
  for (auto& body : scene.bodies) {
    named(body.file, body.cache);
    if (body.moves) named(body.moves->file);
  }
  for (auto& camera : scene.cameras) named(camera.file);
  for (auto& field : scene.fields) named(field.file);
  for (auto& map : scene.maps) named(map.file, map.texture);
}

/// So that the scene can be read and written from anywhere. One that cannot be made absolute stays as it is.
void makePathsAbsolute(SceneFile& scene);

}  // namespace ringlet
