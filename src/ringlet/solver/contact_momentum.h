// What hair gave to hair in the last step, summed: nothing, but for what the iteration left.
#pragma once

#include "ringlet/base/result.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/solver/device_groom.h"

namespace ringlet {

/// |sum J| over the sum of their sizes; J_a = what pairs and the volume add to the right-hand side, less
/// (2 D + g) v of the last iterate, in kg m/s. What a pinned particle received is not known, and left out.
/// Cost: linear in particles, on the host.
Result<double> contactMomentumError(const DeviceChunk& hair, const RestState& rest, ContactKinds kinds);

}  // namespace ringlet
