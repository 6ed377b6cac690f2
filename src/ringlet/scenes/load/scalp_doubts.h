// What is odd about a scalp in its scene: a sentence for a person each.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ringlet/groom/groom.h"
#include "ringlet/motion/head_scalp.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// Whether strands run from tip to root, by the mesh where roots are bound to it; `name` is the scalp's.
std::optional<std::string> doubtOfRootEnds(const MeshMotion& mesh, const Groom& groom, const Motion& head,
                                           const HeadScalpChoice& binding, const std::string& name);

/// Bodies carried by the head, which do not bend, into which a scalp that bends takes roots: deeper than at
/// the start by 3 mm, at one of nine times from the first frame to the last. Hair that starts inside a body
/// is stretched over it. Cost: that of HeadScalp::placesAt nine times.
std::vector<std::string> doubtsOfRigidBodies(const LoadedScene& scene);

}  // namespace ringlet
