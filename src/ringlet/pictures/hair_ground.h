// HairGround: the surface that following hairs stand on, and factors that differ from strand to strand.
#pragma once

#include <memory>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/bodies/triangle_mesh.h"
#include "ringlet/motion/head_scalp.h"
#include "ringlet/pictures/hair_look.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// Everything it refers to must outlive plans made with it.
struct HairGround {
  std::shared_ptr<const TriangleMesh> mesh{};    // surface of the roots, in the groom's axes [m]; or none
  const HeadScalp* scalp = nullptr;              // the scalp with this mesh, which carries roots; null: the
                                                 // head carries them
  std::span<const float> densities{}, clumps{};  // factor for each strand; empty: all 1
};

/// The ground of a scene. `scalp`: the one that carries the strands' roots, or null. The mesh is the one that
/// `look` names; if none, that of a body; if none, the scalp's.
Result<HairGround> hairGroundOf(const SceneHairs& hairs, const HeadScalp* scalp, const HairLook& look,
                                double metresPerUnit);
Result<HairGround> hairGroundOf(const LoadedScene& scene, const HairLook& look);

/// The ground without a scene.
Result<HairGround> hairGroundOf(const HairLook& look, double metresPerUnit);

}  // namespace ringlet
