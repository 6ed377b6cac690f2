// Meshes that bend without a file: the generated bust (bodies/bust_mesh.h), which nods and shrugs, and its
// cape.
#pragma once

#include <memory>
#include <string_view>

#include "ringlet/motion/mesh_motion.h"

namespace ringlet {

/// From rest at 0 s: the chin goes towards the chest by 35 degrees and back, then the shoulders rise by 4 cm
/// and sink again; at rest from 3.5 s on. The hem of the cape (bodies/cape_mesh.h) is lifted by a wind
/// meanwhile. `name`: bust or cape; null for another.
std::shared_ptr<const MeshMotion> generatedMotion(std::string_view name);

}  // namespace ringlet
