// Implements scenes/load/scene_scalp.h.
#include "ringlet/scenes/load/scene_scalp.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ringlet/base/quoted.h"
#include "ringlet/groom/root_ends.h"
#include "ringlet/motion/head_scalp.h"
#include "ringlet/scenes/load/moving_mesh.h"
#include "ringlet/scenes/load/scalp_doubts.h"

namespace ringlet {
namespace {

struct ScalpMesh {
  std::shared_ptr<const MeshMotion> mesh;
  HeadScalpChoice binding;
};

// A body has read its mesh already, and the two have the same points.
Result<ScalpMesh> meshOfBody(const SceneFile& file, const LoadedScene& loaded) {
  const auto moving = std::ranges::find(loaded.moving, file.scalp.body, [&](const MovingBody& one) {
    return std::string_view(file.bodies[one.body].name);
  });
  if (moving == loaded.moving.end())
    return Error{fmt::format("no body named {} deforms", ringlet::quoted(file.scalp.body))};
  return ScalpMesh{moving->mesh, {.start = moving->start, .offset = moving->offset}};
}

Result<ScalpMesh> meshOfScalp(const SceneFile& file, LoadedScene& loaded) {
  if (!file.scalp.body.empty()) return meshOfBody(file, loaded);
  auto read = readMovingMesh(sourceOf(file.scalp), file, loaded);
  if (!read) return read.error();
  return ScalpMesh{std::move(read->mesh), {.start = file.scalp.start, .offset = read->offset}};
}

}  // namespace

Status loadScalp(const SceneFile& file, LoadedScene& loaded) {
  const SceneScalp& scene = file.scalp;
  const std::string name = scene.body.empty() ? scene.file.string() : scene.body;
  auto read = meshOfScalp(file, loaded);
  if (!read) return Error{fmt::format("the scalp: {}", read.error().message), read.error().fault};

  auto& [mesh, binding] = *read;
  binding.farthest = scene.farthest;
  const std::vector<Vec3d> roots = rootPlaces(loaded.groom);
  const auto ends = doubtOfRootEnds(*mesh, loaded.groom, loaded.motion, binding, "the scalp " + name);
  auto scalp = HeadScalp::bind(mesh, roots, loaded.motion, binding);
  if (!scalp) {
    return Error{fmt::format("the scalp {}: {}{}", name, scalp.error().message,
                             ends ? fmt::format("; {}", *ends) : std::string())};
  }
  if (ends) loaded.warnings.push_back(*ends);
  loaded.scalp = std::move(*scalp);
  return {};
}

}  // namespace ringlet
