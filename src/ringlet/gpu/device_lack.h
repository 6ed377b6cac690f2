// Why a device cannot be used.
#pragma once

#include <string>

#include "ringlet/gpu/device.h"

namespace ringlet::gpu {

/// What the device lacks of what the solver needs, in words with numbers; empty: nothing.
std::string findLack(const DeviceProperties& p, const DeviceOptions& options);

}  // namespace ringlet::gpu
