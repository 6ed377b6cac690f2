// BustMotion: the generated bust (bodies/bust_mesh.h), which nods and shrugs: a mesh that bends without a
// file.
#pragma once

#include <memory>

#include "ringlet/motion/mesh_motion.h"

namespace ringlet {

/// From rest at 0 s: the chin goes towards the chest by 35 degrees and back, then the shoulders rise by 4 cm
/// and sink again; at rest from 3.5 s on.
std::shared_ptr<const MeshMotion> makeBustMotion();

}  // namespace ringlet
