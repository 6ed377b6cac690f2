// Every kernel and shape that could be planned on a device.
#pragma once

#include <string>
#include <vector>

#include "ringlet/gpu/kernel.h"
#include "ringlet/solver/compute_device.h"

namespace ringlet::program {

struct ListedKernel {
  std::string name;  // "strand_step, bodies in air, lanes 4 x 16"
  gpu::KernelDescription description;
};

/// Always in the same order on the same device.
std::vector<ListedKernel> listKernels(const ComputeDevice& device);

}  // namespace ringlet::program
