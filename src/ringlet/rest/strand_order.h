// The order of strands in memory. Iben et al. 2012, section 4, gives hairs that touch to one processor, by
// greedy swaps; here it is caches and workgroups that want them side by side.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/groom/groom.h"
#include "ringlet/rest/contact_graph.h"
#include "ringlet/rest/rest_state.h"

namespace ringlet {

/// A device order for buildRestState: the groom's strands by rising particle count, equals along a Hilbert
/// curve through the strands' mean points. Cost: n log n.
std::vector<std::uint32_t> orderAlongCurve(const Groom& groom);

/// A device order, of the groom that `rest` was built from, in which strands that overlap are nearer: strands
/// of one particle count change places, in rest's order, where that shortens the sum over overlaps of the
/// distance of both strands in memory. A strand goes to the middle of its neighbours' places. Stops after
/// `passes`, or one that gains less than a thousandth, which is about 20. Cost: a pass is linear in overlaps.
std::vector<std::uint32_t> improveOrder(const RestState& rest, std::span<const StrandOverlap> overlaps,
                                        int passes);

}  // namespace ringlet
