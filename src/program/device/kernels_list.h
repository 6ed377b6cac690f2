// Every kernel and shape that could be planned on a device.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ringlet/gpu/kernel.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/strand_shape.h"

namespace ringlet::program {

struct ListedKernel {
  std::string name;  // "strand_step, bodies in air, lanes 4 x 16"
  gpu::KernelDescription description;
};

/// Always in the same order on the same device. `shapes`: strand kernels in these with runs in registers, and
/// not in those that are planned and in the serial form.
std::vector<ListedKernel> listKernels(const ComputeDevice& device, std::span<const StrandShape> shapes = {});

}  // namespace ringlet::program
