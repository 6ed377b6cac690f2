// What hair gave to hair in the last step, summed: nothing, but for what the iteration left.
#pragma once

#include <cstddef>
#include <functional>

#include "ringlet/base/result.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/solver/device_groom.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {

/// Sums of J_a = what pairs and the volume add to the right-hand side, less (2 D + g) v of the last iterate,
/// over the strands (device order) that are here. What a pinned particle received is not known, and left out.
/// Cost: linear in particles, on the host.
Result<ContactMomentum> contactMomentum(const DeviceChunk& hair, const RestState& rest, ContactKinds kinds,
                                        const std::function<bool(std::size_t)>& isHere);

}  // namespace ringlet
