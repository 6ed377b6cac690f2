// The device of a command; and what $RINGLET_WITHOUT lets it do without, and $RINGLET_GROUP_SIZE otherwise,
// to compare.
#pragma once

#include <string>

#include "ringlet/gpu/device.h"
#include "ringlet/solver/compute_device.h"

namespace ringlet::program {

/// Of words with commas between: texels (kernels read storage buffers), timestamps (the host's clock times),
/// mapping (buffers are filled through others), full_subgroups, atomic_int64. Errors: another word.
Result<gpu::DeviceOptions> optionsWithout(const std::string& words);

/// As ComputeDevice::open, with the program's cache of kernels and $RINGLET_WITHOUT.
Result<ComputeDevice> openDevice(const std::string& choice);

/// $RINGLET_GROUP_SIZE, for KernelChoice::groupSize; 0 where it is not set. Errors: no whole number above 0.
Result<int> groupSizeAsked();

/// A sentence for the warnings of a run; empty where nothing is left out.
std::string whatIsLeftOut();

}  // namespace ringlet::program
