// EdgeFactors: the factors by which profiles multiply the constants of a particle's edge.
#pragma once

#include <cstddef>

#include "layout/strands.h"

namespace ringlet {

struct EdgeFactors {
  layout::vec3 stiffness;  // of stretch, bending and core
  float stretchDamping;
  float bendDamping;
  float coreDamping;
  float unused[2];
};

// Kernels read it as a ParticleRest, behind which it is stored.
static_assert(sizeof(EdgeFactors) == sizeof(layout::ParticleRest) &&
              offsetof(EdgeFactors, stretchDamping) == offsetof(layout::ParticleRest, stretchRestLength) &&
              offsetof(EdgeFactors, bendDamping) == offsetof(layout::ParticleRest, mass) &&
              offsetof(EdgeFactors, coreDamping) == offsetof(layout::ParticleRest, edgeLength));

}  // namespace ringlet
