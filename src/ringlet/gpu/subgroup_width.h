// How many invocations a subgroup is given, where the driver lets the program choose.
#pragma once

#include <cstdint>

#include "ringlet/gpu/device.h"

namespace ringlet::gpu {

/// The width for kernels that ask for no other, from what the driver states (vendor, reported width, range,
/// whether it can be chosen).
///
///   AMD gfx10 and later   32: the hardware's own width. Its drivers report 64, which they make of two
///   halves:
///                         every shuffle then takes three operations, and code does not fit its cache
///   Intel                 the smallest: a wide subgroup has fewer registers an invocation and spills
///   others                what the driver reports, but no wider than a workgroup, which has to hold it
std::uint32_t defaultSubgroupSize(const DeviceProperties& stated);

/// Whether kernels can be given subgroups of `width`: a power of two of the range, where the driver lets the
/// program choose; else only what the driver gives.
bool hasSubgroupSize(const DeviceProperties& properties, std::uint32_t width);

}  // namespace ringlet::gpu
