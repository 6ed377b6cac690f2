// World-space bind: a groom, or a body, that was modelled where it stands in the world at some frame, and
// from then on goes with what carries it, whatever axes that has.
//
//   at the bind frame  x_world = x_modelled
//   at t               x_world = carrier(t) carrier(bind)^-1 x_modelled
//
// The head's own axes give way to the world's: the groom is rest and upright as it was modelled, so that
// gravity is balanced in that pose. Its origin is the joint, for small numbers in float32.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ringlet/groom/groom.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/motion.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet {

/// When each stands where it was modelled [s]; nothing: it is in the frame of what carries it.
struct WorldBind {
  std::optional<double> groom{};
  std::vector<std::optional<double>> bodies{};  // of each
};

WorldBind worldBindOf(const SceneFile& scene);

/// Into the frames of what carries them: the groom's points and the head's axes, then the bodies' places. As
/// many bodies as the scene has, their motions read. What is bound to its carrier stays, bit for bit.
void bindInWorld(const WorldBind& bind, Motion& head, Groom& groom, std::span<Body> bodies);

}  // namespace ringlet
