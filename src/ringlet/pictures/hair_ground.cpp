// Implements hair_ground.h.
#include "ringlet/pictures/hair_ground.h"

#include <utility>

#include "ringlet/bodies/mesh_file.h"

namespace ringlet {

Result<HairGround> hairGroundOf(const HairLook& look, double metresPerUnit) {
  HairGround ground;
  if (look.scalp.empty()) return ground;
  auto mesh = readObjMesh(look.scalp, metresPerUnit);
  if (!mesh) return mesh.error();
  ground.mesh = std::make_shared<const TriangleMesh>(std::move(*mesh));
  return ground;
}

Result<HairGround> hairGroundOf(const SceneHairs& hairs, const HeadScalp* scalp, const HairLook& look,
                                double metresPerUnit) {
  auto ground = hairGroundOf(look, metresPerUnit);
  if (!ground) return ground;
  ground->densities = hairs.densities;
  ground->clumps = hairs.clumps;
  if (!ground->mesh) ground->mesh = hairs.scalp;
  if (!ground->mesh && scalp) {
    ground->mesh = std::make_shared<const TriangleMesh>(scalp->meshAtBinding());
    ground->scalp = scalp;
  }
  return ground;
}

Result<HairGround> hairGroundOf(const LoadedScene& scene, const HairLook& look) {
  // With root shifts, roots move relative to the head and leave the scalp.
  const bool isCarried = scene.scalp && scene.rootShifts.empty();
  return hairGroundOf(scene.hairs, isCarried ? &*scene.scalp : nullptr, look, scene.groom.metresPerUnit);
}

}  // namespace ringlet
