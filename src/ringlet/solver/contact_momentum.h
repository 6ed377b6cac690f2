// The sum of the momenta that contacts exchanged in the last step: 0 but for the error of the iteration.
#pragma once

#include <cstddef>
#include <functional>

#include "ringlet/base/result.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/solver/device_groom.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {

/// Sums J_a, the terms that pairs and the volume add to the right-hand side minus (2 D + g) v of the last
/// iterate, over the strands (device order) that are stepped here. Pinned particles are left out, since what
/// they received is unknown.
/// Cost: linear in particles, on the host.
Result<ContactMomentum> contactMomentum(const DeviceChunk& hair, const RestState& rest, ContactKinds kinds,
                                        const std::function<bool(std::size_t)>& isHere);

}  // namespace ringlet
