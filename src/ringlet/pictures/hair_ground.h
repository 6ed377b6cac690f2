// HairGround: what hairs that follow strands stand on, and how they differ from strand to strand.
#pragma once

#include <memory>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/bodies/triangle_mesh.h"
#include "ringlet/motion/head_scalp.h"
#include "ringlet/pictures/hair_look.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// What it refers to must outlive what is planned with it.
struct HairGround {
  std::shared_ptr<const TriangleMesh> mesh{};    // that roots are on, in the groom's axes [m]; or none
  const HeadScalp* scalp = nullptr;              // whose mesh it is; it carries roots, else the head does
  std::span<const float> densities{}, clumps{};  // factors of each strand; empty: all 1
};

/// Of a scene. `scalp`: that carries the strands' roots, or none. A mesh that `look` names comes first, then
/// that of a body, then the scalp's.
Result<HairGround> hairGroundOf(const SceneHairs& hairs, const HeadScalp* scalp, const HairLook& look,
                                double metresPerUnit);
Result<HairGround> hairGroundOf(const LoadedScene& scene, const HairLook& look);

/// Without a scene.
Result<HairGround> hairGroundOf(const HairLook& look, double metresPerUnit);

}  // namespace ringlet
