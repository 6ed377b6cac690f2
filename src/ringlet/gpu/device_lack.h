// Why a device cannot be used.
#pragma once

#include <string>

#include "ringlet/gpu/device.h"

namespace ringlet::gpu {

/// The needs of the solver that the device does not meet, in words with numbers; empty: none.
std::string findLack(const DeviceProperties& p, const DeviceOptions& options);

}  // namespace ringlet::gpu
