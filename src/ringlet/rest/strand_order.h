// The order of strands in memory. Iben et al. 2012, section 4, gives hairs that touch to one processor; here
// it is caches and workgroups that want them side by side. The paper improves its order by greedy swaps.
// Along a curve, that halved the distance of overlapping strands in memory once more and gained no time: on a
// shaken head of 1,000 curls (lavapipe) contacts took 5 to 20 % less along the curve than in the groom's
// order, and the same after swaps.
#pragma once

#include <cstdint>
#include <vector>

#include "ringlet/groom/groom.h"

namespace ringlet {

/// A device order for buildRestState: the groom's strands by rising particle count, equals along a Hilbert
/// curve through the strands' mean points. Cost: n log n.
std::vector<std::uint32_t> orderAlongCurve(const Groom& groom);

}  // namespace ringlet
