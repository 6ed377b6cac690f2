// Implements scenes/scene_paths.h.
#include "ringlet/scenes/scene_paths.h"

#include <span>
#include <variant>

#include "ringlet/scenes/scene_fields.h"

namespace ringlet {
namespace {

using Paths = std::vector<std::filesystem::path*>;

template <class Owner>
void add(std::span<const SceneField<Owner>> fields, Owner& owner, Paths& paths) {
  for (const SceneField<Owner>& field : fields) {
    if (const auto* member = std::get_if<std::filesystem::path Owner::*>(&field.member))
      paths.push_back(&(owner.**member));
  }
}

}  // namespace

std::vector<std::filesystem::path*> pathsOf(SceneFile& scene) {
  Paths paths{&scene.goalFile};
  add(groomFields(), scene.groom, paths);
  add(motionFields(), scene.motion, paths);
  add(scalpFields(), scene.scalp, paths);
  for (SceneBody& body : scene.bodies) {
    add(bodyFields(), body, paths);
    if (body.motion) add(motionFields(), *body.motion, paths);
  }
  for (SceneCamera& camera : scene.cameras) add(cameraFields(), camera, paths);
  for (SceneForceField& field : scene.fields) add(forceFieldFields(), field, paths);
  for (SceneMap& map : scene.maps) add(mapFields(), map, paths);
  add(outputFields(), scene.output, paths);
  return paths;
}

}  // namespace ringlet
