// CoreWeights: a guide's core as weighted sums of its particles. smoothCore is linear in the points, so that
// weights found once serve every pose, on any device.
#pragma once

#include <cstddef>
#include <vector>

#include "ringlet/follow/guide_rest.h"

namespace ringlet {

/// The core at a particle is the sum of weights[k] times particle first + k of the guide.
struct CoreWeights {
  std::size_t first = 0;
  std::vector<float> weights;
};

/// One a particle. Cost: a core (smoothCore) for every particle within three windows.
std::vector<CoreWeights> coreWeightsOf(const GuideRest& guide);

}  // namespace ringlet
