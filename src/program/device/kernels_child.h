// Compiles a kernel in a process of its own, since drivers may crash while they compute statistics.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "program/device/kernels_list.h"
#include "ringlet/base/result.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/kernel_executables.h"

namespace ringlet::program {

/// The result for one kernel.
struct CompiledKernel {
  bool isCompiled = false;
  std::string trouble{};                  // why it was not compiled, or that the driver crashed in its
                                          // statistics
  std::optional<std::uint32_t> subgroup;  // none: the driver's choice, which it does not report
  double seconds = 0;                     // compile time
  std::vector<gpu::KernelStatistic> statistics{};
};

/// Compiles in this process, on a device opened for it.
CompiledKernel compileKernel(const ComputeDevice& device, const ListedKernel& kernel);

/// In the child: prints the result of compileKernel as one line.
void printCompiled(const CompiledKernel& compiled);

/// In the parent: runs this program again with these arguments and reads that line. If the child dies, the
/// kernel counts as not compiled, and the result names the signal.
CompiledKernel compileInChild(const std::vector<std::string>& arguments);

}  // namespace ringlet::program
