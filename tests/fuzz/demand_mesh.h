// What every mesh that moves must keep, whatever the file it was read from.
#pragma once

#include "ringlet/motion/mesh_motion.h"
#include "tests/fuzz/fuzz_target.h"

namespace ringlet::fuzz {

inline void demandMesh(const MeshMotion& mesh) {
  demand(!mesh.triangles().empty() && mesh.firstSeconds() <= mesh.lastSeconds(),
         "a mesh has faces and times");
  for (const auto& triangle : mesh.triangles())
    for (const std::uint32_t corner : triangle) demand(corner < mesh.pointCount(), "corners are points");
  for (const double t : {mesh.firstSeconds(), (mesh.firstSeconds() + mesh.lastSeconds()) / 2, 1e9})
    demand(mesh.pointsAt(t).size() == mesh.pointCount(), "all points are there");
}

}  // namespace ringlet::fuzz
