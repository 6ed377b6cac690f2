// The sum of the momenta that contacts exchanged in the last step: 0 except for the error of the iteration.
#pragma once

#include "ringlet/base/result.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/solver/simulation.h"
#include "ringlet/solver/strands/device_groom.h"

namespace ringlet {

/// Sums J_a, the terms that pairs and the volume add to the right-hand side minus (2 D + g) v of the last
/// iterate, over the strands that are stepped here. Pinned particles are left out, since what they received
/// is unknown. Cost: linear in particles, on the host.
Result<ContactMomentum> contactMomentum(const DeviceChunk& hair, const RestState& rest, ContactKinds kinds);

}  // namespace ringlet
