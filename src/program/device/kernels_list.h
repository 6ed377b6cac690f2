// Lists every kernel and shape that may be planned on a device.
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

/// The order is always the same on the same device. `shapes`: strand kernels have these shapes, with runs in
/// registers, instead of the planned ones and the serial form.
std::vector<ListedKernel> listKernels(const ComputeDevice& device, std::span<const StrandShape> shapes = {});

}  // namespace ringlet::program
