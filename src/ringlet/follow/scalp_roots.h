// Roots of hairs on a scalp: blue noise on a mesh about the roots of guides.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/bodies/triangle_mesh.h"
#include "ringlet/follow/guide_rest.h"

namespace ringlet {

struct ScalpRoots {
  std::vector<Vec3d> places;  // on the mesh [m]
  // Of each, above 0 to 1: those up to a share are about that share of all, and evenly spread too.
  std::vector<float> ranks;
};

/// `count` places on the scalp, evenly spread (groom/sample_elimination.h) where guides stand and three
/// quarters of their distance further: not on parts of the mesh that face another way than where the nearest
/// guide stands, as the inside of a shell. Errors: the mesh's (checkMesh); no guide is on it. Cost: some 20
/// us a root.
Result<ScalpRoots> scatterRoots(const TriangleMesh& scalp, std::span<const GuideRest> guides, int count,
                                std::uint64_t seed);

}  // namespace ringlet
