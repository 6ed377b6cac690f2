// Opens a command's device. For comparisons, $RINGLET_WITHOUT switches features off, and $RINGLET_GROUP_SIZE
// sets the workgroup size.
#pragma once

#include <string>

#include "ringlet/gpu/device.h"
#include "ringlet/solver/compute_device.h"

namespace ringlet::program {

/// Reads words separated by commas: texels (kernels read storage buffers), timestamps (times are measured by
/// the host's clock), mapping (buffers are filled through staging buffers), full_subgroups, atomic_int64.
/// Errors: another word.
Result<gpu::DeviceOptions> optionsWithout(const std::string& words);

/// As ComputeDevice::open, with the program's cache of kernels and $RINGLET_WITHOUT.
Result<ComputeDevice> openDevice(const std::string& choice);

/// $RINGLET_GROUP_SIZE, for KernelChoice::groupSize; 0 if unset. Errors: not an integer above 0.
Result<int> groupSizeAsked();

/// A sentence for the warnings of a run; empty if nothing is switched off.
std::string whatIsLeftOut();

}  // namespace ringlet::program
