// Implements scenes/load/moving_mesh.h.
#include "ringlet/scenes/load/moving_mesh.h"

#include <fmt/format.h>

#include "ringlet/motion/file_axis.h"
#include "ringlet/motion/mesh_motion_file.h"

namespace ringlet {

MovingMeshSource sourceOf(const SceneScalp& scalp) {
  return {.file = scalp.file,
          .cache = scalp.cache,
          .mesh = scalp.mesh,
          .animation = scalp.animation,
          .up = scalp.up,
          .metresPerUnit = scalp.metresPerUnit,
          .framesPerSecond = scalp.framesPerSecond};
}

MovingMeshSource sourceOf(const SceneBody& body) {
  return {.file = body.file,
          .cache = body.cache,
          .mesh = body.mesh,
          .animation = body.animation,
          .up = {},
          .metresPerUnit = body.metresPerUnit,
          .framesPerSecond = body.framesPerSecond};
}

Result<MovingMesh> readMovingMesh(const MovingMeshSource& source, const SceneFile& file,
                                  LoadedScene& loaded) {
  const SceneMotion& head = file.motion;
  std::error_code code;  // files that are not there are no error of this
  const bool isHeads = !head.file.empty() && std::filesystem::equivalent(head.file, source.file, code);
  MeshMotionChoice choice{
      .path = source.file,
      .cache = source.cache,
      .mesh = source.mesh,
      .animation = source.animation,
      .metresPerUnit = source.metresPerUnit,
      .up = fileAxisNamed(source.up),
      .framesPerSecond = source.framesPerSecond.value_or(loaded.settings.framesPerSecond)};
  if (isHeads && choice.animation.empty()) choice.animation = head.animation;
  if (isHeads && !choice.metresPerUnit) choice.metresPerUnit = head.metresPerUnit;
  if (isHeads && !choice.up) choice.up = fileAxisNamed(head.up);
  if (!choice.metresPerUnit && isWithoutUnit(source.file)) choice.metresPerUnit = loaded.groom.metresPerUnit;
  auto mesh = readMeshMotion(choice, file.groom.up == "Z");
  if (!mesh) return mesh.error();
  for (const std::string& warning : (*mesh)->warnings())
    loaded.warnings.push_back(fmt::format("{}: {}", source.file.string(), warning));
  return MovingMesh{std::move(*mesh), isHeads ? loaded.motion.start : Vec3d{}};
}

}  // namespace ringlet
